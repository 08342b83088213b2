// Small files of the formats that are text: what unit tests damage and fuzz targets start from.
#pragma once

#include <string>

namespace asset_test {

// Two strands of 2 and 3 vertices.
inline std::string smallTfxText() {
  return "version 2.0\nscale 1.0\nrotation 0 0 0\ntranslation 0.0 0.0 0.0\nbothEndsImmovable 1\nmaxNumVerticesInStrand 16\n"
         "numFollowHairsPerGuideHair 0\nmaxRadiusAroundGuideHair 0.5\nnumStrands 2\nis sorted 1\n"
         "strand 0 numVerts 2 texcoord 0.25 0.5\n0.0 0.125 0.25\n000000 0.5 1e-1\n"
         "strand 1 numVerts 3 texcoord 0.75,0.5\n1, 2, 3\n1.5, +2, -3\n.5, 2, 3.25\n";
}

// Two strands of 2 and 3 vertices with everything, as text.
inline std::string smallPlyText() {
  return "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 5\nproperty float x\nproperty float y\nproperty double z\nproperty uchar red\n"
         "property uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float thickness\nelement strand 2\nproperty ushort nsegs\n"
         "element edge 3\nproperty list uchar int ends\nend_header\n"
         "0 0 0 255 0 0 255 0.5\n0 1 0 0 255 0 255 0.25\n1 0 0 0 0 255 255 0.5\n1 1 0 51 51 51 255 0.25\n1 2 0.125 0 0 0 0 0.125\n1\n2\n"
         "2 0 1\n2 2 3\n2 3 4\n";
}

}  // namespace asset_test
