// SPDX-License-Identifier: BSD-3-Clause
// The figures of the paper, measured on its own recordings and machine.
#pragma once

#include <array>
#include <string_view>

namespace sslcd::benchmark {

/// Table II: RMSE, STD and Max of each case, after Sim(3). [m]
struct PaperAteRow {
  const char* method;
  std::array<std::array<double, 3>, 4> cases;
};
inline constexpr std::array<PaperAteRow, 6> kPaperAte{{
    {"ORB-SLAM3",
     {{{1.989, 0.494, 2.666},
       {3.604, 1.551, 5.558},
       {3.538, 1.465, 5.614},
       {0.626, 0.199, 0.998}}}},
    {"VINS-Fusion",
     {{{1.670, 0.825, 3.229},
       {1.336, 0.806, 2.702},
       {0.814, 0.418, 1.756},
       {0.720, 0.299, 1.130}}}},
    {"CubeSLAM",
     {{{4.228, 1.241, 5.967},
       {3.944, 1.320, 5.661},
       {1.623, 1.306, 4.001},
       {1.880, 2.208, 8.295}}}},
    {"Lin et al.",
     {{{0.722, 0.807, 4.151},
       {0.931, 0.472, 1.948},
       {3.820, 2.869, 12.66},
       {0.600, 0.166, 1.115}}}},
    {"Ji et al. w/o refinement",
     {{{0.660, 0.808, 4.126},
       {1.191, 0.516, 2.312},
       {1.490, 1.623, 2.489},
       {0.834, 0.210, 1.114}}}},
    {"Ji et al.",
     {{{0.501, 0.289, 0.914},
       {0.550, 0.231, 0.867},
       {0.368, 0.141, 0.889},
       {0.161, 0.069, 0.303}}}},
}};

/// Table III, by the names of sslcd's stages. [ms]
struct PaperTime {
  std::string_view stage;
  double ms;
};
inline constexpr std::array<PaperTime, 4> kPaperTimes{{{"data association", 35.2},
                                                       {"object optimisation", 4.3},
                                                       {"loop detection", 1.8},
                                                       {"drift correction", 48.4}}};

/// Table I: mean 3D IoU on KITTI tracking sequences by number.
struct PaperIou {
  std::string_view sequence;
  double cubeslam, visualdet3d, paper;
};
inline constexpr std::array<PaperIou, 3> kPaperIou{
    {{"0007", 0.210, 0.455, 0.586}, {"0009", 0.190, 0.287, 0.311}, {"0011", 0.190, 0.348, 0.446}}};

}  // namespace sslcd::benchmark
