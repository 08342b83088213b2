// Which rows belong together, which of them are best, which are doubtful.
#include "report_facts.h"
#include "study_fixture.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace forelock::samples;
using forelock::test::goodRow;
using forelock::test::studyHeader;
using forelock::test::studyLine;

namespace {

StudyTable tableOf(const std::vector<forelock::test::StudyFields>& rows) {
  std::string csv = studyHeader();
  for (const auto& row : rows) csv += studyLine(row);
  return parseStudy(csv, "study.csv");
}

forelock::test::StudyFields changed(forelock::test::StudyFields row, const forelock::test::StudyFields& changes) {
  for (const auto& [column, value] : changes) row[column] = value;
  return row;
}

}  // namespace

TEST(ParetoFront, KeepsWhatNothingBeats) {
  const PlanePoint points[] = {{3, 1}, {1, 5}, {2, 2}, {2.5, 3}, {1, 6}, {NAN, 0}, {4, 1}, {0.5, INFINITY}};
  EXPECT_EQ(paretoFront(points), (std::vector<size_t>{1, 2, 0}));
  const PlanePoint equal[] = {{1, 1}, {1, 1}, {2, 1}};
  EXPECT_EQ(paretoFront(equal), (std::vector<size_t>{0, 1}));
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(ReportFacts, ReadableNumbers) {
  EXPECT_EQ(readableNumber(0.012345), "0.0123");
  EXPECT_EQ(readableNumber(1.5), "1.50");
  EXPECT_EQ(readableNumber(45.678), "45.7");
  EXPECT_EQ(readableNumber(1234567.8), "1,234,568");
  EXPECT_EQ(readableNumber(0.0), "0");
  EXPECT_EQ(readableNumber(kUnknown), "-");
  EXPECT_EQ(readableCount(1000.0), "1,000");
}

TEST(ReportFacts, TimesAreThoseOfPairs) {
  const StudyTable table = tableOf({goodRow("core_tail", 0.7, 1), changed(goodRow("forward", 1.4, 1), {{"ms_total", "2.1"}}),
                                    changed(goodRow("exact", 1, 1), {{"ms_total", "1.5"}, {"shadow_size", "512"}}),
                                    changed(goodRow("all_low", 1, 1), {{"pair_ratio", ""}}), changed(goodRow("core_only", 0.3, 1), {{"view", "35k"}})});
  const StudyFacts facts(table, "rmse_exact");
  EXPECT_NEAR(facts.timeOf(table.rows[0]), 0.7, 1e-9) << "the baseline is its own";
  EXPECT_NEAR(facts.timeOf(table.rows[1]), 1.4, 1e-5) << "it was busy, but so was the baseline beside it";
  EXPECT_NEAR(facts.timeOf(table.rows[2]), 1.5, 1e-9) << "its baseline had another shadow map";
  EXPECT_NEAR(facts.timeOf(table.rows[3]), 1, 1e-9) << "no pairs";
  EXPECT_NEAR(facts.timeOf(table.rows[4]), 0.3, 1e-9) << "no baseline in its view";
}

TEST(ReportFacts, DoubtIsSaid) {
  const StudyTable table = tableOf({goodRow("a", 1, 1), changed(goodRow("b", 1, 1), {{"deterministic", "0"}}),
                                    changed(goodRow("c", 1, 1), {{"pair_spread", "0.3"}}), changed(goodRow("d", 1, 1), {{"status", "not finite"}}),
                                    changed(goodRow("e", 1, 1), {{"status", ""}}), changed(goodRow("f", 1, 1), {{"deterministic", ""}})});
  EXPECT_EQ(whyDoubtful(table.rows[0]), "");
  EXPECT_NE(whyDoubtful(table.rows[1]).find("same bits"), std::string::npos);
  EXPECT_NE(whyDoubtful(table.rows[2]).find("30 %"), std::string::npos) << whyDoubtful(table.rows[2]);
  EXPECT_EQ(whyDoubtful(table.rows[3]), "not finite");
  EXPECT_EQ(whyDoubtful(table.rows[4]), "no status");
  EXPECT_EQ(whyDoubtful(table.rows[5]), "") << "unknown is no failure";
}

TEST(ReportFacts, LinesGoOverDialsAndTheRestStaysAtItsBase) {
  const StudyTable table = tableOf(
      {goodRow("core_tail", 0.7, 1.4), changed(goodRow("core_tail", 0.6, 40), {{"k", "0"}}),
       changed(goodRow("core_tail", 0.8, 0.5), {{"k", "16"}, {"k_sort", "16"}}), changed(goodRow("core_tail", 0.68, 2), {{"core_taps", "9"}}),
       changed(goodRow("core_tail", 0.9, 1.3), {{"shadow_size", "2048"}}), changed(goodRow("core_tail", 0.7, 1.6), {{"payload", "paper"}}),
       changed(goodRow("all_low", 0.5, 45), {{"k", "0"}}), goodRow("zebra", 1, 1), goodRow("forward", 1.4, 2)});
  const StudyFacts facts(table, "rmse_exact");
  EXPECT_EQ(facts.methods, (std::vector<std::string>{"forward", "core_tail", "all_low", "zebra"}));
  const std::vector<Series> series = facts.errorSeries(facts.main);
  ASSERT_EQ(series.size(), 5u);
  EXPECT_EQ(series[0].dial, nullptr);
  EXPECT_EQ(series[1].method, "core_tail");
  EXPECT_STREQ(series[1].dial->column, "k");
  ASSERT_EQ(series[1].rows.size(), 3u);
  EXPECT_EQ(series[1].rows[0]->k, 0.0);
  EXPECT_EQ(series[1].rows[2]->k, 16.0);
  EXPECT_STREQ(series[2].dial->column, "core_taps");
  EXPECT_EQ(series[2].rows.size(), 2u);
  EXPECT_EQ(facts.baseRow(facts.main, "all_low"), &table.rows[6]) << "its one value is its base";
  std::string swept;
  for (const Sweep& sweep : facts.sweeps(facts.main)) swept += std::string(sweep.dial->column) + " ";
  EXPECT_EQ(swept, "k core_taps shadow_size payload ");
  EXPECT_NEAR(facts.forwardRatio(facts.main).value, 2.0, 1e-4);
  EXPECT_TRUE(facts.forwardRatio(facts.main).paired);
}

TEST(ReportFacts, WhatWasMeasuredAgainCountsOnce) {
  const StudyTable table = tableOf({goodRow("forward", 1.4, 2), goodRow("core_tail", 0.7, 1), goodRow("forward", 1.2, 2)});
  const StudyFacts facts(table, "rmse_exact");
  EXPECT_EQ(facts.liveRows().size(), 2u);
  EXPECT_EQ(facts.replaced_rows, 1u);
  EXPECT_EQ(facts.baseRow(facts.main, "forward")->ms_total, 1.2);
}

TEST(ReportFacts, AllFailedIsAStudyToo) {
  const StudyTable table = tableOf({changed(goodRow("forward", 1, 1), {{"ms_total", ""}, {"rmse_exact", ""}, {"status", "failed: no"}, {"k", ""}, {"view", ""}})});
  const StudyFacts facts(table, "rmse_exact");
  EXPECT_TRUE(facts.errorSeries(facts.main).empty());
  EXPECT_TRUE(facts.sweeps(facts.main).empty());
  EXPECT_TRUE(facts.settings.empty());
  EXPECT_EQ(facts.doubtfulRows().size(), 1u);
  EXPECT_THROW(StudyFacts(table, "device"), StudyError);
}
