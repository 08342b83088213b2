// tinygltf as it is used here: no images. Its TINYGLTF_NO_FS does not compile in 2.7.0, so files are kept from it by callbacks
// of our own. SPDX-License-Identifier: MIT
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_USE_CPP14
#include <tiny_gltf.h>
