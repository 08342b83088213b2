// Text that came with the data stays text, in the page and in gnuplot's scripts.
#include "report_page.h"
#include "study_fixture.h"

#include <gtest/gtest.h>

using namespace forelock::samples;

TEST(ReportPage, Base64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64(std::string("\xff\xfe\xfd\0", 4)), "//79AA==");
}

TEST(ReportPage, NamesAreEscaped) {
  EXPECT_EQ(escapeHtml("<b a=\"x\">'&'</b>"), "&lt;b a=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/b&gt;");
  const std::string bad = "<script>alert('x')</script>";
  auto row = forelock::test::goodRow(bad, 1, 1);
  for (const char* column : {"asset", "view", "capture", "store", "payload", "hair_colour", "commit", "device", "driver", "status"}) row[column] = bad;
  StudyTable table = parseStudy(forelock::test::studyHeader() + forelock::test::studyLine(row) + forelock::test::studyLine(row), "study.csv");
  table.device.asset = table.device.command = table.device.device = bad;
  const StudyFacts facts(table, "rmse_exact");
  Pictures pictures;
  pictures.missing = {bad};
  Plots plots;
  plots.problems = {bad};
  const std::string page = makePage({facts, plots, pictures, true, "nowhere", bad});
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
}

TEST(ReportPlots, TextCannotLeaveItsQuotes) {
  EXPECT_EQ(gnuplotText("core_tail, k 8"), "'core_tail, k 8'");
  EXPECT_EQ(gnuplotText("a'; system(\"x\")`y`\n@z\\$"), "'a_; system(_x_)_y__" "_z__'");
}

TEST(ReportPlots, FileNamesStayInTheirFolder) {
  std::set<std::string> taken;
  EXPECT_EQ(fileStem("../../etc/passwd", taken), "_.._etc_passwd");
  EXPECT_EQ(fileStem("a b", taken), "a_b");
  EXPECT_EQ(fileStem("a/b", taken), "a_b-2");
  EXPECT_EQ(fileStem("..", taken), "_");
  EXPECT_LE(fileStem(std::string(5000, 'x'), taken).size(), 90u);
}

TEST(ReportPlots, MethodsKeepTheirColours) {
  const StudyTable table = parseStudy(forelock::test::studyHeader() + forelock::test::studyLine(forelock::test::goodRow("ours", 1, 1)) +
                                          forelock::test::studyLine(forelock::test::goodRow("theirs", 1, 1)),
                                      "study.csv");
  const StudyFacts facts(table, "rmse_exact");
  EXPECT_EQ(methodStyle(facts, "core_tail").color, "#0072b2");
  EXPECT_NE(methodStyle(facts, "ours").color, methodStyle(facts, "theirs").color);
}
