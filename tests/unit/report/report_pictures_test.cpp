// Pictures: the reader of .pfm, colours, and what is measured in them.
#include "float_picture.h"
#include "report_pictures.h"
#include "study_fixture.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>

using namespace forelock::samples;
using forelock::test::writePfm;
using forelock::test::writeText;
namespace fs = std::filesystem;

namespace {

struct Folder {
  Folder() : path(fs::temp_directory_path() / ("forelock-report-" + std::to_string(getpid()))) { fs::create_directories(path / "report"); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

}  // namespace

TEST(FloatPicture, ReadsBottomUpAndBothByteOrders) {
  const Folder folder;
  writePfm(folder.path / "a.pfm", 2, 2, 1, {1, 2, 3, NAN});
  const FloatPicture picture = readPfm((folder.path / "a.pfm").string());
  EXPECT_EQ(picture.values, (std::vector<float>{3, 0, 1, 2}));
  EXPECT_EQ(picture.not_finite, 1u);
  writeText(folder.path / "b.pfm", std::string("Pf\n1 1\n1.0\n\x3f\x80\0\0", 15));
  EXPECT_EQ(readPfm((folder.path / "b.pfm").string()).values, std::vector<float>{1});
}

TEST(FloatPicture, RefusesWhatItsHeaderPromisesInVain) {
  const Folder folder;
  const std::string path = (folder.path / "a.pfm").string();
  for (const char* text : {"", "PF", "P6\n1 1\n255\nabc", "PF\n16000 16000\n-1.0\nabcd", "PF\n-1 5\n-1.0\n", "PF\n99999999999999999999 1\n-1.0\n",
                           "Pf\n1 1\n0\nabcd", "Pf\n1 1\nnan\nabcd", "Pf\n1 1\n-1.0\nabcde"}) {
    writeText(path, text);
    EXPECT_THROW(readPfm(path), std::runtime_error) << text;
  }
  EXPECT_THROW(readPfm((folder.path / "none.pfm").string()), std::runtime_error);
}

TEST(ReportPictures, ColoursOfTheLegend) {
  EXPECT_EQ(layersColor(1).css(), "#bcbcbc");  // linear 0.5
  EXPECT_EQ(layersColor(100).css(), layersColor(5000).css());
  EXPECT_GT(layersColor(8).b, 200);
  EXPECT_GT(layersColor(50).g, 200);
  EXPECT_EQ(differenceColor(2.0).css(), differenceColor(1.0).css());
  int last = -1;
  for (int i = 0; i <= 20; ++i) {  // lighter is more
    const PictureColor color = differenceColor(i / 20.0);
    const int light = 2 * color.r + 7 * color.g + color.b;
    EXPECT_GT(light, last) << i;
    last = light;
  }
}

TEST(ReportPictures, MeasuresDifferencesAndNamesWhatIsMissing) {
  const Folder folder;
  forelock::test::writeStudy(folder.path);
  const StudyTable table = readStudy(folder.path.string());
  const StudyFacts facts(table, "rmse_exact");
  const Pictures pictures = makePictures(facts, folder.path.string(), folder.path.string(), [](uint64_t, uint64_t) {});
  ASSERT_EQ(pictures.layers.size(), 2u);
  EXPECT_EQ(pictures.layers[0].view, "35k") << "fewest pixels first";
  EXPECT_EQ(pictures.layers[0].hair_pixels, 20u * 16u);
  EXPECT_EQ(pictures.layers[0].most, 120u);
  EXPECT_EQ(pictures.histograms[0].pixels[0], 4u * 16u);
  ASSERT_EQ(pictures.groups.size(), 1u);
  ASSERT_EQ(pictures.groups[0].methods.size(), 2u);
  const MethodPicture &core_tail = pictures.groups[0].methods[0], &exact = pictures.groups[0].methods[1];
  EXPECT_EQ(core_tail.method, "core_tail");
  EXPECT_NEAR(core_tail.rmse, 25.5 / std::sqrt(320.0), 1e-3);  // one channel of one of 320 pixels
  EXPECT_NEAR(core_tail.p999, 25.5, 1e-3);
  EXPECT_EQ(exact.rmse, 0.0);
  EXPECT_TRUE(exact.detail.empty());
  EXPECT_TRUE(fs::exists(folder.path / core_tail.difference));
  std::string missing;
  for (const std::string& name : pictures.missing) missing += name + " ";
  EXPECT_EQ(missing, "images/198k-dark-forward-compute.pfm images/198k-dark-core_only-compute.pfm images/198k-dark-all_low-compute.pfm "
                     "images/35k-dark-R_exact.pfm ");
  std::string problems;
  for (const std::string& problem : pictures.problems) problems += problem + "\n";
  EXPECT_NE(problems.find("hair pixels, the table says 35,000"), std::string::npos) << problems;
}
