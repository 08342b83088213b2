// SPDX-License-Identifier: MIT
#include "view_gpu.h"

namespace forelock::samples {

void ViewGpu::load(const HeadlessHost& host) {
  shared = host.device();
  device = shared.device;
  const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(shared.get_instance_proc_addr(shared.instance, "vkGetDeviceProcAddr"));
#define FORELOCK_VIEW_LOAD(name) name = reinterpret_cast<PFN_##name>(get(device, #name));
  FORELOCK_VIEW_FUNCTIONS(FORELOCK_VIEW_LOAD)
#undef FORELOCK_VIEW_LOAD
}

}  // namespace forelock::samples
