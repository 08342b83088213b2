/* Strict C99 against the static library: an asset, and what it says of itself. */
#include <forelock/render.h>

#include <stdio.h>

int main(void) {
  static const float positions[] = {0, 0, 0, 0, 0, 1, 0, 0, 2};
  static const uint32_t first_vertex[] = {0, 3};
  const FlkStrands strands = {.type = FLK_TYPE_STRANDS, .strand_count = 1, .vertex_count = 3,
                              .first_vertex = first_vertex, .positions = positions};
  FlkAsset asset = NULL;
  FlkAssetInfo info;
  FlkRequirements requirements;
  if (flkGetVersion() != (FLK_VERSION_MAJOR << 22 | FLK_VERSION_MINOR << 12 | FLK_VERSION_PATCH)) return 1;
  if (flkAssetCreate(&strands, NULL, &asset) != FLK_SUCCESS) return 2;
  if (flkAssetGetInfo(asset, &info) != FLK_SUCCESS || info.vertex_count != 3) return 3;
  flkAssetDestroy(asset);
  flkGetRequirements(&requirements);
  if (requirements.api_version < VK_API_VERSION_1_3) return 4;
  printf("consumer_c: %s\n", flkResultName(FLK_SUCCESS));
  return 0;
}
