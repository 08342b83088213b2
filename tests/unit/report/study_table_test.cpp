// The reader of study.csv on what a study writes, and on what it never should.
#include "study_fixture.h"
#include "study_table.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace forelock::samples;
using forelock::test::goodRow;
using forelock::test::studyHeader;
using forelock::test::studyLine;

namespace {

std::string complaintOf(const std::string& csv) {
  try {
    parseStudy(csv, "study.csv");
  } catch (const StudyError& error) {
    return error.what();
  }
  return "";
}

forelock::test::StudyFields with(const std::string& column, const std::string& value) {
  auto row = goodRow("forward", 1.0, 2.0);
  row[column] = value;
  return row;
}

std::string joined(const StudyTable& table) {
  std::string text;
  for (const std::string& warning : table.warnings) text += warning + "\n";
  return text;
}

}  // namespace

TEST(StudyCsv, QuotesLineEndsAndEmptyFields) {
  const std::vector<CsvRecord> records = parseCsv("a,\"b,\"\"c\"\"\nd\",\r\n\r\n1,2\"2,\n,x");
  ASSERT_EQ(records.size(), 3u);  // the empty line is none
  EXPECT_EQ(records[0].fields, (std::vector<std::string>{"a", "b,\"c\"\nd", ""}));
  EXPECT_EQ(records[1].fields, (std::vector<std::string>{"1", "2\"2", ""}));
  EXPECT_EQ(records[1].line, 4u);
  EXPECT_TRUE(records[1].whole);
  EXPECT_EQ(records[2].fields, (std::vector<std::string>{"", "x"}));
  EXPECT_FALSE(records[2].whole);
}

TEST(StudyTable, UnknownIsNotZero) {
  const StudyTable table = parseStudy(studyHeader() + studyLine(with("tau", "")), "study.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_TRUE(std::isnan(table.rows[0].tau));
  EXPECT_EQ(table.rows[0].ms_total, 1.0);
  EXPECT_EQ(table.rows[0].line, 2u);
  EXPECT_TRUE(table.warnings.empty()) << joined(table);
}

TEST(StudyTable, RefusesWhatIsNoStudy) {
  EXPECT_NE(complaintOf("").find("is empty"), std::string::npos);
  EXPECT_NE(complaintOf("\n\n").find("is empty"), std::string::npos);
  EXPECT_NE(complaintOf(studyHeader()).find("no row"), std::string::npos);
  std::string header = studyHeader();
  header.replace(header.find(",ms_p95"), 7, "");
  EXPECT_NE(complaintOf(header + studyLine(goodRow("forward", 1, 1))).find("lacks the column ms_p95"), std::string::npos);
  EXPECT_NE(complaintOf("view,view\na,b\n").find("twice"), std::string::npos);
}

TEST(StudyTable, WorksWithoutTheLaterColumnsAndWithUnknownOnes) {
  std::string header = studyHeader();
  header.replace(header.find("frame_noise,"), std::string::npos, "of_tomorrow,pair_ratio,pair_spread\n");
  const StudyTable table = parseStudy(header + studyLine(with("frame_noise", "many words")), "study.csv");
  EXPECT_TRUE(std::isnan(table.rows.at(0).frame_noise));
  EXPECT_EQ(table.rows.at(0).pair_spread, 0.05);
}

TEST(StudyTable, LeavesOutATornLineAndSaysSo) {
  const std::string row = studyLine(goodRow("forward", 1, 1));
  const StudyTable torn = parseStudy(studyHeader() + row + row.substr(0, row.size() / 2), "study.csv");
  EXPECT_EQ(torn.rows.size(), 1u);
  EXPECT_NE(joined(torn).find("line 3 is torn off"), std::string::npos) << joined(torn);
  const StudyTable open_quote = parseStudy(studyHeader() + row + "\"groom" + row, "study.csv");
  EXPECT_EQ(open_quote.rows.size(), 1u);
  EXPECT_NE(joined(open_quote).find("torn"), std::string::npos) << joined(open_quote);
  const StudyTable middle = parseStudy(studyHeader() + "a,b\n" + row, "study.csv");
  EXPECT_EQ(middle.rows.size(), 1u);
  EXPECT_NE(joined(middle).find("line 2 has 2 fields instead of"), std::string::npos) << joined(middle);
}

TEST(StudyTable, TakesImpossibleNumbersAsUnknown) {
  for (const char* value : {"nan", "inf", "-inf", "-3", "1e999", "1e300", "12 ms", "0x10", "--", "1,5"}) {
    const StudyTable table = parseStudy(studyHeader() + studyLine(with("ms_total", value)), "study.csv");
    EXPECT_TRUE(std::isnan(table.rows.at(0).ms_total)) << value;
    EXPECT_NE(joined(table).find("line 2: ms_total is "), std::string::npos) << value << ": " << joined(table);
  }
}

TEST(StudyTable, CutsHugeFieldsAndManyWarnings) {
  const StudyTable huge = parseStudy(studyHeader() + studyLine(with("device", std::string(3000000, '"'))), "study.csv");
  EXPECT_EQ(huge.rows.at(0).device.size(), 2000u);
  std::string csv = studyHeader();
  for (int i = 0; i < 3000; ++i) csv += studyLine(with("rmse_exact", "nan"));
  const StudyTable many = parseStudy(csv, "study.csv");
  EXPECT_EQ(many.rows.size(), 3000u);
  EXPECT_LT(many.warnings.size(), 20u);
  EXPECT_NE(joined(many).find("more values like these"), std::string::npos);
}

TEST(StudyTable, NoBytesBreakIt) {
  // Every prefix, and every byte replaced by each of a few that mean something.
  const std::string good = studyHeader() + studyLine(goodRow("forward", 1, 1)) + studyLine(with("status", "failed, \"so\""));
  const size_t header = studyHeader().size();
  for (size_t i = 0; i < good.size(); i += 3) complaintOf(good.substr(0, i));
  for (size_t i = header; i < good.size(); i += 2) {
    for (const char c : {'"', ',', '\n', '\r', '\0', '\xff', '-'}) {
      std::string changed = good;
      changed[i] = c;
      complaintOf(changed);
    }
  }
}

TEST(StudyDevice, OddJsonIsAWarning) {
  StudyTable table;
  parseStudyDevice("{\"device\": 12, \"bandwidth_gb_s\": \"fast\", \"views\": [1, {\"name\": \"a\", \"fragments\": -1}]}", "device.json", table);
  EXPECT_EQ(table.device.device, "12");
  EXPECT_TRUE(std::isnan(table.device.bandwidth_gb_s));
  ASSERT_EQ(table.device.views.size(), 1u);
  EXPECT_TRUE(std::isnan(table.device.views[0].fragments));
  parseStudyDevice("[1, 2", "device.json", table);
  EXPECT_NE(joined(table).find("device.json is no JSON object"), std::string::npos);
}
