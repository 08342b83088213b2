// The RAII header: who owns what after moves, resets and failures. Destruction is seen as host memory going back.
#include <forelock/forelock.hpp>

#include <gtest/gtest.h>

#include <cstdlib>
#include <type_traits>

namespace {

struct CountingMemory {
  long live = 0;
  FlkHostAllocator callbacks{this,
                             [](void* user, size_t size, size_t alignment) -> void* {
                               ++static_cast<CountingMemory*>(user)->live;
                               const size_t least = alignment < sizeof(void*) ? sizeof(void*) : alignment;
                               return std::aligned_alloc(least, (size + least) / least * least);
                             },
                             [](void* user, void* memory, size_t, size_t) {
                               --static_cast<CountingMemory*>(user)->live;
                               std::free(memory);
                             }};
};

const float kPositions[] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1};
const uint32_t kFirstVertex[] = {0, 2, 4};

FlkStrands twoStrands() {
  FlkStrands strands = forelock::strandsDesc();
  strands.strand_count = 2;
  strands.vertex_count = 4;
  strands.first_vertex = kFirstVertex;
  strands.positions = kPositions;
  return strands;
}

template <class T>
constexpr bool kMoveOnly =
    std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
    !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T> && sizeof(T) == sizeof(void*);
static_assert(kMoveOnly<forelock::Asset> && kMoveOnly<forelock::Context> && kMoveOnly<forelock::Hair> &&
              kMoveOnly<forelock::View>);

TEST(Owner, destroysOnceAndMoves) {
  CountingMemory memory;
  FlkAssetOptions options = forelock::assetOptions();
  options.allocator = &memory.callbacks;
  {
    forelock::Asset asset;
    EXPECT_EQ(asset.get(), nullptr);
    ASSERT_EQ(forelock::create(twoStrands(), &options, asset), FLK_SUCCESS);
    const FlkAsset handle = asset;
    EXPECT_NE(handle, nullptr);
    const long one_asset = memory.live;
    EXPECT_GT(one_asset, 0);

    forelock::Asset moved = std::move(asset);
    EXPECT_EQ(asset.get(), nullptr);
    EXPECT_EQ(moved.get(), handle);
    EXPECT_EQ(memory.live, one_asset);

    forelock::Asset other;
    ASSERT_EQ(forelock::create(twoStrands(), &options, other), FLK_SUCCESS);
    EXPECT_EQ(memory.live, 2 * one_asset);
    other = std::move(moved);
    EXPECT_EQ(other.get(), handle);
    EXPECT_EQ(memory.live, one_asset);

    forelock::Asset& same = other;
    other = std::move(same);
    EXPECT_EQ(other.get(), handle);
    other.reset(handle);
    EXPECT_EQ(other.get(), handle);
    EXPECT_EQ(memory.live, one_asset);

    const FlkAsset released = other.release();
    EXPECT_EQ(memory.live, one_asset);
    forelock::Asset taken(released);
    taken.reset();
    EXPECT_EQ(memory.live, 0);
    ASSERT_EQ(forelock::create(twoStrands(), &options, other), FLK_SUCCESS);
  }
  EXPECT_EQ(memory.live, 0);
}

TEST(Owner, failureKeepsWhatIsHeld) {
  forelock::Asset asset;
  ASSERT_EQ(forelock::create(twoStrands(), nullptr, asset), FLK_SUCCESS);
  const FlkAsset handle = asset;
  EXPECT_EQ(forelock::load("/there/is/no/such.tfx", nullptr, asset), FLK_ERROR_IO);
  EXPECT_EQ(forelock::load("not strands", 11, nullptr, asset), FLK_ERROR_FORMAT_UNKNOWN);
  EXPECT_EQ(asset.get(), handle);
}

TEST(Owner, contextHairViewInOrder) {
  CountingMemory memory;
  {
    FlkContextDesc context_desc = forelock::contextDesc();
    context_desc.allocator = &memory.callbacks;
    forelock::Context context;
    ASSERT_EQ(forelock::create(context_desc, context), FLK_SUCCESS);
    forelock::Asset asset;
    ASSERT_EQ(forelock::create(twoStrands(), nullptr, asset), FLK_SUCCESS);
    forelock::Hair hair;
    FlkHairDesc hair_desc = forelock::hairDesc();
    hair_desc.asset = asset;
    ASSERT_EQ(forelock::create(context, hair_desc, hair), FLK_SUCCESS);
    forelock::View view;
    ASSERT_EQ(forelock::create(context, forelock::viewDesc(), view), FLK_SUCCESS);
    EXPECT_GT(memory.live, 0);
    // An owner is taken where a handle is.
    FlkHairInfo info;
    EXPECT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
    EXPECT_EQ(info.strand_count, 2u);
  }
  EXPECT_EQ(memory.live, 0);
}

}  // namespace
