#include "gpu/shader_code.h"

#include "shaders_spv/all.h"

namespace forelock {
namespace {

struct Shader {
  ShaderId id;
  uint8_t images;
  std::span<const uint32_t> words;
};

const Shader kShaders[] = {
#define FLK_SHADER(id, images, words) {ShaderId::id, images, words},
#include "shaders_spv/table.inc"
#undef FLK_SHADER
};

// Fowler, Noll, Vo: FNV-1a, a word at a time.
void add(uint64_t& hash, uint32_t word) { hash = (hash ^ word) * 0x100000001B3u; }

void addModule(uint64_t& hash, std::span<const uint32_t> words, const uint32_t* constants) {
  constexpr uint32_t kHeader = 5, kDecorate = 71, kSpecId = 1;  // of the SPIR-V specification
  for (const uint32_t word : words) add(hash, word);
  for (std::size_t at = kHeader; at < words.size(); at += words[at] >> 16) {
    if (words[at] >> 16 == 0) return;
    if ((words[at] & 0xFFFF) == kDecorate && words[at + 2] == kSpecId && words[at + 3] < FLK_SPEC_COUNT)
      add(hash, constants[words[at + 3]]);
  }
}

}  // namespace

std::span<const uint32_t> shaderCode(ShaderId id, uint8_t images) {
  for (const Shader& shader : kShaders)
    if (shader.id == id && shader.images == images) return shader.words;
  return {};
}

uint64_t recipeHash(const Recipe& recipe) {
  uint64_t hash = 0xCBF29CE484222325u;
  if (recipe.vertex != ShaderId::none) addModule(hash, shaderCode(recipe.vertex, 0), recipe.constants);
  if (recipe.main != ShaderId::none) addModule(hash, shaderCode(recipe.main, recipe.images), recipe.constants);
  return hash;
}

}  // namespace forelock
