// study.csv and cached references: what a kill or a bad disk leaves behind.
#include "csv.h"
#include "reference_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace forelock::study {
namespace {

namespace fs = std::filesystem;

class StudyFiles : public testing::Test {
protected:
  StudyFiles() : folder_(fs::temp_directory_path() / ("forelock-study-" + std::to_string(getpid()))) { fs::create_directories(folder_); }
  ~StudyFiles() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& name, const std::string& content) const { std::ofstream(path(name), std::ios::binary) << content; }

  fs::path folder_;
};

Row row(const std::string& view, double ms) {
  Row r;
  r.set("view", view), r.set("ms_total", ms), r.set("device", "a, b \"c\""), r.set("status", "ok");
  return r;
}

TEST_F(StudyFiles, RowsComeBackAsTheyWere) {
  {
    StudyFile file(path("a.csv"));
    file.append(row("198k", 1.25));
    file.append(row("35k", 1e-7));
  }
  const StudyFile file(path("a.csv"));
  ASSERT_EQ(file.rows().size(), 2u);
  EXPECT_EQ(file.rows()[0]["device"], "a, b \"c\"");
  EXPECT_EQ(file.rows()[1]["ms_total"], "1e-07");
  EXPECT_EQ(file.rows()[1]["tau"], "");
}

TEST_F(StudyFiles, ATornLastLineIsCutOffWhereverItWasTorn) {
  {
    StudyFile file(path("b.csv"));
    file.append(row("198k", 1));
  }
  const std::string one = text("b.csv");
  {
    StudyFile file(path("b.csv"));
    file.append(row("35k", 2));
  }
  const std::string two = text("b.csv");
  for (std::size_t length = one.size(); length < two.size(); ++length) {
    write("c.csv", two.substr(0, length));
    {
      StudyFile file(path("c.csv"));
      ASSERT_EQ(file.rows().size(), 1u) << length;
      file.append(row("35k", 2));
    }
    ASSERT_EQ(text("c.csv"), two) << length;
  }
  write("c.csv", two.substr(0, 20));  // killed in the header
  StudyFile file(path("c.csv"));
  EXPECT_EQ(file.rows().size(), 0u);
}

TEST_F(StudyFiles, WhatIsNoStudyStaysWhole) {
  for (const std::string content : {"hello", "hello\n", "asset,view\n1,2\n"}) {
    write("d.csv", content);
    EXPECT_THROW(StudyFile(path("d.csv")), StudyFileError);
    EXPECT_EQ(text("d.csv"), content);
  }
  { StudyFile file(path("e.csv")); }
  const std::string broken = text("e.csv") + "1,2,3\n";
  write("e.csv", broken);
  EXPECT_THROW(StudyFile(path("e.csv")), StudyFileError);
  EXPECT_EQ(text("e.csv"), broken);
}

TEST_F(StudyFiles, FieldsAreQuotedAndStayOneLine) {
  std::vector<std::string> fields;
  EXPECT_EQ(csvLine({"a", "b,c", "d\"e", "f\ng", ""}), "a,\"b,c\",\"d\"\"e\",\"f g\",");
  EXPECT_TRUE(parseCsvLine("a,\"b,c\",\"d\"\"e\",", fields));
  EXPECT_EQ(fields, (std::vector<std::string>{"a", "b,c", "d\"e", ""}));
  EXPECT_FALSE(parseCsvLine("a,\"b", fields));
  EXPECT_FALSE(parseCsvLine("a,\"b\"c", fields));
  Row r;
  r.set("ms_total", std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(r["ms_total"], "");  // unknown is empty
  EXPECT_THROW(r.set("no_such", "1"), std::logic_error);
}

TEST_F(StudyFiles, DamagedReferencesAreNotThere) {
  const ReferenceCache cache(path("references"));
  Picture made, read;
  made.width = 3, made.height = 2;
  for (int i = 0; i < 6; ++i) made.rgb.insert(made.rgb.end(), {0.1f * float(i), 0.2f, -0.0f}), made.transmittance.push_back(0.5f), made.fragments.push_back(uint32_t(i));
  cache.save("k", made);
  ASSERT_TRUE(cache.load("k", read));
  EXPECT_TRUE(sameBits(made, read));
  EXPECT_EQ(made.fragments, read.fragments);
  std::vector<float> gray;
  EXPECT_FALSE(cache.load("k", gray));   // of another kind
  EXPECT_FALSE(cache.load("l", read));
  const std::string whole = text("references/k.ref");
  for (std::size_t length : {std::size_t(0), std::size_t(39), std::size_t(40), whole.size() - 1}) {
    write("references/k.ref", whole.substr(0, length));
    EXPECT_FALSE(cache.load("k", read)) << length;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {  // any flipped byte
    std::string changed = whole;
    changed[i] = char(changed[i] ^ 0x10);
    write("references/k.ref", changed);
    EXPECT_FALSE(cache.load("k", read)) << i;
  }
  write("references/l.ref", whole);  // under another name
  EXPECT_FALSE(cache.load("l", read));
}

}  // namespace
}  // namespace forelock::study
