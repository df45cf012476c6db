// SPDX-License-Identifier: BSD-3-Clause
#include "formats/npy.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

template <class T>
std::string Bytes(const std::vector<T>& values) {
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string Npy(const std::string& type, const std::string& shape, const std::string& data,
                int version = 1, const std::string& fortran = "False") {
  const std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }\n";
  std::string file = std::string("\x93NUMPY") + static_cast<char>(version) + '\0' +
                     static_cast<char>(header.size()) + '\0';
  if (version > 1) file += std::string(2, '\0');
  return file + header + data;
}

const std::vector<float> kValues = {1, 2, 3, 4, 5, -6.5f};

TEST(Npy, ReadsFloatsOfEveryVersion) {
  const TempFolder folder;
  const std::vector<double> doubles(kValues.begin(), kValues.end());
  for (const std::string& file :
       {Npy("<f4", "(2, 3)", Bytes(kValues)), Npy("<f4", "(2, 3)", Bytes(kValues), 2),
        Npy("<f8", "(2, 3)", Bytes(doubles), 3)}) {
    const NpyMatrix matrix = ReadNpy(folder.Write("a.npy", file));
    EXPECT_EQ(matrix.rows, 2u);
    EXPECT_EQ(matrix.columns, 3u);
    EXPECT_EQ(matrix.values, kValues);
    EXPECT_EQ(matrix.Row(1)[2], -6.5f);
  }
}

TEST(Npy, ReadsEmptyArrays) {
  const TempFolder folder;
  EXPECT_TRUE(ReadNpy(folder.Write("a.npy", Npy("<f4", "(0, 3)", ""))).values.empty());
  EXPECT_TRUE(ReadNpy(folder.Write("a.npy", Npy("<f4", "(3, 0)", ""))).values.empty());
}

TEST(Npy, WritesWhatItReads) {
  const TempFolder folder;
  const std::string bytes = NpyBytes({2, 3, kValues});
  EXPECT_EQ((bytes.size() - 6 * sizeof(float)) % 64, 0u);
  EXPECT_EQ(ReadNpy(folder.Write("a.npy", bytes)).values, kValues);
  EXPECT_EQ(ReadNpy(folder.Write("a.npy", NpyBytes({0, 3, {}}))).columns, 3u);
}

TEST(Npy, RefusesWhatItCannotRead) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& file, const char* part) {
    ExpectError([&] { ReadNpy(folder.Write("a.npy", file)); }, {"a.npy: ", part});
  };
  const std::string good = Npy("<f4", "(2, 3)", Bytes(kValues));
  refuse("", "not a NumPy");
  refuse("1 2 3 4 5 6 7 8", "not a NumPy");
  refuse(good.substr(0, 40), "truncated");
  refuse(good.substr(0, good.size() - 1), "does not match");
  refuse(good + "x", "does not match");
  refuse(Npy("<f4", "(2, 3)", Bytes(kValues), 9), "unknown npy version");
  refuse(Npy("<f4", "(2, 3)", Bytes(kValues), 1, "True"), "Fortran");
  refuse(Npy("<i4", "(2, 3)", Bytes(kValues)), "found '<i4'");
  refuse(Npy(">f4", "(2, 3)", Bytes(kValues)), "found '>f4'");
  refuse(Npy("<f4", "(6,)", Bytes(kValues)), "two dimensions");
  refuse(Npy("<f4", "(1, 2, 3)", Bytes(kValues)), "two dimensions");
  refuse(Npy("<f4", "(9223372036854775807, 2)", Bytes(kValues)), "does not match");
}

}  // namespace
}  // namespace sslcd
