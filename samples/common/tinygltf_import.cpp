// The parser itself, which its header holds. SPDX-License-Identifier: MIT
#define TINYGLTF_IMPLEMENTATION
#include "tinygltf_import.h"
