// What the tests of rigs share: small files by hand, loading that checks what holds whatever comes of it.
#pragma once

#include "../../fuzz/rig_invariants.h"
#include "asset_kit.h"

namespace asset_test {

struct DestroyRig {
  void operator()(FlkRig rig) const { flkRigDestroy(rig); }
};
using OwnedRig = std::unique_ptr<FlkRig_T, DestroyRig>;

struct LoadedRig {
  FlkResult result = FLK_NOT_READY;
  Caught caught;
  OwnedRig rig;

  FlkRigInfo info() const {
    FlkRigInfo info{};
    flkRigGetInfo(rig.get(), &info);
    return info;
  }
  FlkRigArrays arrays() const {
    FlkRigArrays arrays{};
    flkRigGetArrays(rig.get(), &arrays);
    return arrays;
  }
  std::vector<float> weights(uint32_t record) const {
    const float* from = arrays().weights + size_t{record} * 4;
    return {from, from + 4};
  }
  std::vector<uint32_t> bones(uint32_t record) const {
    const uint32_t* from = arrays().bones + size_t{record} * 4;
    return {from, from + 4};
  }
  // count 0: there is no such finding.
  FlkFinding finding(const std::string& code) const {
    FlkFinding finding{};
    for (uint32_t i = 0; rig && i < info().finding_count; ++i)
      if (flkRigGetFinding(rig.get(), i, &finding) == FLK_SUCCESS && finding.code == code) return finding;
    return FlkFinding{};
  }
  std::string codes() const {
    std::string joined;
    FlkFinding finding{};
    for (uint32_t i = 0; rig && i < info().finding_count; ++i)
      if (flkRigGetFinding(rig.get(), i, &finding) == FLK_SUCCESS) joined += std::string(i ? " " : "") + finding.code;
    return joined;
  }
};

inline std::unique_ptr<LoadedRig> loadRig(const Bytes& bytes, FlkAsset asset = nullptr, uint32_t max_bones = 0, uint32_t max_records = 0) {
  auto loaded = std::make_unique<LoadedRig>();
  FlkRigOptions options{};
  options.type = FLK_TYPE_RIG_OPTIONS;
  options.message = Caught::receive;
  options.message_user = &loaded->caught;
  options.name = "rig";
  options.max_bones = max_bones;
  options.max_records = max_records;
  options.asset = asset;
  // An exact copy on the heap, so that a sanitizer sees a read one byte past the end.
  std::unique_ptr<unsigned char[]> exact(new unsigned char[bytes.size() ? bytes.size() : 1]);
  if (bytes.size()) std::memcpy(exact.get(), bytes.bytes.data(), bytes.size());
  FlkRig rig = reinterpret_cast<FlkRig>(&options);
  loaded->result = flkRigLoadMemory(exact.get(), bytes.size(), &options, &rig);
  loaded->rig.reset(rig);
  if (loaded->result == FLK_SUCCESS) {
    EXPECT_NE(rig, nullptr);
    if (const char* broken = brokenRigPromise(rig)) ADD_FAILURE() << "broken promise: " << broken;
  } else {
    EXPECT_EQ(rig, nullptr);
    EXPECT_LT(loaded->result, 0);
    EXPECT_FALSE(loaded->caught.error().empty());
    for (const Caught::Message& message : loaded->caught.all)
      EXPECT_TRUE(message.text.rfind("rig: ", 0) == 0 && isSentence(message.text.c_str())) << message.text;
  }
  return loaded;
}

inline void expectRigRefused(const Bytes& file, FlkResult result, const char* id, const std::string& says) {
  const auto loaded = loadRig(file);
  EXPECT_EQ(loaded->result, result) << flkResultName(loaded->result) << "\n" << loaded->caught.text();
  EXPECT_EQ(loaded->caught.error(), id) << loaded->caught.text();
  EXPECT_NE(loaded->caught.text().find(says), std::string::npos) << loaded->caught.text();
}

}  // namespace asset_test
