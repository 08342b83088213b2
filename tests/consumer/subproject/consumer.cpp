// C++17 against the shared library: a plan without a device, through the RAII header.
#include <forelock/forelock.hpp>

#include <cstdio>

int main() {
  const float positions[] = {0, 0, 0, 0, 0, 1};
  const uint32_t first_vertex[] = {0, 2};
  FlkStrands strands = forelock::strandsDesc();
  strands.strand_count = 1;
  strands.vertex_count = 2;
  strands.first_vertex = first_vertex;
  strands.positions = positions;
  forelock::Asset asset;
  if (forelock::create(strands, nullptr, asset) != FLK_SUCCESS) return 1;
  forelock::Context context;
  if (forelock::create(forelock::contextDesc(), context) != FLK_SUCCESS) return 2;
  forelock::Hair hair;
  FlkHairDesc desc = forelock::hairDesc();
  desc.asset = asset;
  if (forelock::create(context, desc, hair) != FLK_SUCCESS) return 3;
  FlkHairInfo info;
  if (flkHairGetInfo(hair, &info) != FLK_SUCCESS || info.segment_count != 1) return 4;
  std::printf("consumer_cpp: %llu bytes\n", static_cast<unsigned long long>(info.bytes_device));
}
