// The library's suspicions on grooms of every style: nothing is said of hair that is right, and hair turned around is found.
#include "asset_source.h"
#include "strand_edit.h"

#include <gtest/gtest.h>

namespace forelock::samples {
namespace {

std::string codesOf(const OpenedAsset& opened) {
  std::string codes;
  for (const AssetFinding& finding : findingsOf(opened)) codes += (codes.empty() ? "" : " ") + finding.code;
  return codes;
}

}  // namespace

TEST(GroomFindings, NoneOfHairThatIsRightAndRootAtTipOfHairTurnedAround) {
  const std::vector<std::string> names = groomNames();
  ASSERT_GE(names.size(), 5u);
  for (const std::string& name : names) {
    Recipe recipe = openRecipe("groom:" + name);
    recipe.strands = 3000;  // findings look at 2,048 of them
    const OpenedAsset groom = growAsset(recipe, name);
    EXPECT_EQ(codesOf(groom), "") << name;
    FlkStrands held{};
    flkAssetGetStrands(groom.asset.get(), &held);
    EditableStrands turned = editableStrands(held, true);
    reverseStrands(turned);
    EXPECT_EQ(codesOf(assetOf(turned.view(), name)), "ROOT_AT_TIP") << name;
    turned.radii.clear();
    // Tips of hair that is short and straight are a surface as well, which docs/findings.md says.
    EXPECT_EQ(codesOf(assetOf(turned.view(), name)), name == "short-straight" ? "WIDTH_DEFAULTED" : "ROOT_AT_TIP WIDTH_DEFAULTED") << name;
  }
}

}  // namespace forelock::samples
