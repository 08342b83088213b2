// A folder for a test's files, gone with everything in it when the test ends.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <dirent.h>
#include <string>
#include <unistd.h>
#include <vector>

namespace asset_test {

class Folder {
public:
  Folder() {
    char name[] = "/tmp/forelock-test-XXXXXX";
    EXPECT_NE(mkdtemp(name), nullptr);
    path = name;
  }
  ~Folder() {
    for (const std::string& name : entries()) std::remove((path + "/" + name).c_str());
    rmdir(path.c_str());
  }
  std::vector<std::string> entries() const {
    std::vector<std::string> names;
    DIR* folder = opendir(path.c_str());
    while (const dirent* entry = readdir(folder))
      if (entry->d_name[0] != '.') names.push_back(entry->d_name);
    closedir(folder);
    return names;
  }
  std::string path;
};

}  // namespace asset_test
