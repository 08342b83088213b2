// Forelock for C++17: owners of the C API's handles, which go when they go out of scope. SPDX-License-Identifier: MIT
//
// Nothing is added to the C API and nothing is hidden: an owner converts to its handle, so every flk... function takes
// it as it is, and results stay FlkResult. No exceptions, no allocations, no state but the handle. Owners move and are
// not copied. What the C headers say of threads and lifetimes holds: destroy hairs and views before their context, and
// none that a frame in flight uses. Members declared in the order context, hair, view are destroyed in the right one.
//
//   forelock::Asset asset;
//   if (FlkResult result = forelock::load("ponytail.tfx", nullptr, asset)) return result;
//   forelock::Hair hair;
//   FlkHairDesc desc = forelock::hairDesc();
//   desc.asset = asset;
//   if (FlkResult result = forelock::create(context, desc, hair)) return result;
#ifndef FORELOCK_FORELOCK_HPP
#define FORELOCK_FORELOCK_HPP

#include "render.h"
#include "rig.h"

#include <utility>

namespace forelock {

template <class Handle, void (*destroy)(Handle)> class Owner {
public:
  Owner() noexcept = default;
  explicit Owner(Handle handle) noexcept : handle_(handle) {}
  Owner(Owner&& other) noexcept : handle_(other.release()) {}
  Owner& operator=(Owner&& other) noexcept {
    reset(other.release());
    return *this;
  }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  ~Owner() { reset(); }

  Handle get() const noexcept { return handle_; }
  operator Handle() const noexcept { return handle_; }

  // Gives the handle away without destroying it.
  Handle release() noexcept { return std::exchange(handle_, Handle{}); }

  // Destroys what is held and holds `handle` from now on. Holding the same handle again does nothing.
  void reset(Handle handle = Handle{}) noexcept {
    const Handle old = std::exchange(handle_, handle);
    if (old && old != handle) destroy(old);
  }

private:
  Handle handle_ = Handle{};
};

using Asset = Owner<FlkAsset, flkAssetDestroy>;
using Rig = Owner<FlkRig, flkRigDestroy>;
using Context = Owner<FlkContext, flkContextDestroy>;
using Hair = Owner<FlkHair, flkHairDestroy>;
using View = Owner<FlkView, flkViewDestroy>;

// Descriptors with their tag set and everything else zero, which is the documented default of optional fields.
namespace detail {
template <class Desc> Desc tagged(uint32_t type) noexcept {
  Desc desc{};
  desc.type = type;
  return desc;
}
}  // namespace detail
inline FlkStrands strandsDesc() noexcept { return detail::tagged<FlkStrands>(FLK_TYPE_STRANDS); }
inline FlkAssetOptions assetOptions() noexcept { return detail::tagged<FlkAssetOptions>(FLK_TYPE_ASSET_OPTIONS); }
inline FlkRigOptions rigOptions() noexcept { return detail::tagged<FlkRigOptions>(FLK_TYPE_RIG_OPTIONS); }
inline FlkContextDesc contextDesc() noexcept { return detail::tagged<FlkContextDesc>(FLK_TYPE_CONTEXT); }
inline FlkHairDesc hairDesc() noexcept { return detail::tagged<FlkHairDesc>(FLK_TYPE_HAIR); }
inline FlkViewDesc viewDesc() noexcept { return detail::tagged<FlkViewDesc>(FLK_TYPE_VIEW); }
inline FlkFrame frameDesc() noexcept { return detail::tagged<FlkFrame>(FLK_TYPE_FRAME); }

// Each makes what its flk... function makes. On failure `owner` holds what it held before.
namespace detail {
template <class Handle, void (*destroy)(Handle), class Make>
FlkResult make(Owner<Handle, destroy>& owner, Make&& function) noexcept {
  Handle handle{};
  const FlkResult result = function(&handle);
  if (result == FLK_SUCCESS) owner.reset(handle);
  return result;
}
}  // namespace detail
inline FlkResult create(const FlkStrands& strands, const FlkAssetOptions* options, Asset& owner) noexcept {
  return detail::make(owner, [&](FlkAsset* asset) { return flkAssetCreate(&strands, options, asset); });
}
inline FlkResult load(const char* path, const FlkAssetOptions* options, Asset& owner) noexcept {
  return detail::make(owner, [&](FlkAsset* asset) { return flkAssetLoadFile(path, options, asset); });
}
inline FlkResult load(const void* bytes, size_t size, const FlkAssetOptions* options, Asset& owner) noexcept {
  return detail::make(owner, [&](FlkAsset* asset) { return flkAssetLoadMemory(bytes, size, options, asset); });
}
inline FlkResult load(const char* path, const FlkRigOptions* options, Rig& owner) noexcept {
  return detail::make(owner, [&](FlkRig* rig) { return flkRigLoadFile(path, options, rig); });
}
inline FlkResult load(const void* bytes, size_t size, const FlkRigOptions* options, Rig& owner) noexcept {
  return detail::make(owner, [&](FlkRig* rig) { return flkRigLoadMemory(bytes, size, options, rig); });
}
inline FlkResult create(const FlkContextDesc& desc, Context& owner) noexcept {
  return detail::make(owner, [&](FlkContext* context) { return flkContextCreate(&desc, context); });
}
inline FlkResult create(FlkContext context, const FlkHairDesc& desc, Hair& owner) noexcept {
  return detail::make(owner, [&](FlkHair* hair) { return flkHairCreate(context, &desc, hair); });
}
inline FlkResult create(FlkContext context, const FlkViewDesc& desc, View& owner) noexcept {
  return detail::make(owner, [&](FlkView* view) { return flkViewCreate(context, &desc, view); });
}

}  // namespace forelock
#endif
