#include "passes/recipe.h"

namespace forelock {

Recipe prepareRecipe() {
  Recipe recipe;
  recipe.main = ShaderId::prepare;
  return recipe;
}

}  // namespace forelock
