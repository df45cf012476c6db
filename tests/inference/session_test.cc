// SPDX-License-Identifier: BSD-3-Clause
#include "inference/session.h"

#include <cstdlib>

#include "../support/temp_folder.h"
#include "sslcd/core/log.h"
#include "test_models.h"

namespace sslcd {
namespace {

NamedTensors Image(float value) {
  Tensor image{{1, 3, 48, 64}, {}};
  image.values.assign(ElementCount(image.shape), value);
  return {{"images", image}};
}

TEST(Session, KnowsInputsAndOutputs) {
  SSLCD_RUNTIME();
  const Session session(TestModel("boxes_scores_labels.onnx"));
  ASSERT_EQ(session.inputs().size(), 2u);
  EXPECT_EQ(session.inputs()[0].name, "pixels");
  EXPECT_EQ(session.inputs()[0].shape, (TensorShape{1, 3, 48, 64}));
  EXPECT_EQ(session.inputs()[0].type, "float32");
  EXPECT_EQ(session.inputs()[1].type, "int64");
  ASSERT_EQ(session.outputs().size(), 4u);
  EXPECT_EQ(session.outputs()[3].name, "boxes");
  EXPECT_EQ(Session(TestModel("embedding.onnx")).inputs()[0].shape, (TensorShape{-1, 3, 8, 4}));
}

TEST(Session, ReadsWhatTheAuthorStored) {
  SSLCD_RUNTIME();
  const Session session(TestModel("yolox.onnx"));
  EXPECT_EQ(session.Metadata("names"), "{0: 'car', 1: 'person', 2: 'truck'}");
  EXPECT_EQ(session.Metadata("stride"), "");
}

TEST(Session, SameInputSameBytesOnAnyNumberOfThreads) {
  SSLCD_RUNTIME();
  InferenceOptions two;
  two.threads = 2;
  const Session a(TestModel("yolo_v5.onnx")), b(TestModel("yolo_v5.onnx"), two);
  const Tensor first = a.Run(Image(0.3f)).at("output0"), again = a.Run(Image(0.3f)).at("output0");
  EXPECT_EQ(first.shape, (TensorShape{1, 5, 8}));
  EXPECT_EQ(first.values, again.values);
  EXPECT_EQ(first.values, b.Run(Image(0.3f)).at("output0").values);
  EXPECT_NE(first.values, a.Run(Image(0.4f)).at("output0").values);
}

TEST(Session, SurvivesBeingMoved) {
  SSLCD_RUNTIME();
  Session session(TestModel("embedding.onnx"));
  session = Session(TestModel("yolo_v5.onnx"));
  EXPECT_EQ(session.path(), TestModel("yolo_v5.onnx"));
  EXPECT_EQ(session.Run(Image(0)).size(), 1u);
}

TEST(Session, FallsBackToTheCpuAloud) {
  SSLCD_RUNTIME();
  InferenceOptions options;
  options.provider = InferenceOptions::Provider::kCuda;
  std::string heard;
  const LogSink before =
      SetLogSink([&heard](LogLevel, const std::string& message) { heard += message; });
  const Session session(TestModel("yolo_v5.onnx"), options);
  SetLogSink(before);
  const bool fell_back = session.provider() == InferenceOptions::Provider::kCpu;
  const bool said_so =
      heard.find("yolo_v5.onnx: runs on the CPU, because CUDA is missing (") != std::string::npos;
  EXPECT_EQ(said_so, fell_back) << heard;
  EXPECT_THAT(
      session.Run(Image(0.3f)).at("output0").values,
      testing::Pointwise(testing::FloatNear(1e-3f),
                         Session(TestModel("yolo_v5.onnx")).Run(Image(0.3f)).at("output0").values));
}

TEST(Session, RefusesWrongInputs) {
  SSLCD_RUNTIME();
  const Session session(TestModel("yolo_v5.onnx"));
  ExpectError([&] { session.Run({}); }, {"yolo_v5.onnx", "no value for its input 'images'"});
  ExpectError(
      [&] {
        session.Run({{"images", {{1, 3, 4, 4}, std::vector<float>(48)}}});
      },
      {"input 'images' is 1x3x4x4, the model takes 1x3x48x64"});
  ExpectError([&] { session.Run({{"images", {{1, 3, 48, 64}, {1, 2}}}}); }, {"input 'images'"});
}

TEST(Session, RefusesBadModels) {
  SSLCD_RUNTIME();
  const TempFolder folder;
  ExpectError([] { Session("/nowhere/a.onnx"); }, {"/nowhere/a.onnx", "cannot be read"});
  ExpectError([] { Session("/dev/zero"); }, {"/dev/zero: is a device"});
  ExpectError([&] { Session(folder.Write("text.onnx", "this is no model")); },
              {"text.onnx", "ONNX Runtime says"});
  ExpectError([&] { Session(folder.Write("empty.onnx", "")); }, {"empty.onnx"});
  ExpectError([] { Session(TestModel("bad_opset.onnx")); },
              {"bad_opset.onnx", "opset", "export the model again"});
  ExpectError([] { Session(TestModel("bad_type.onnx")); },
              {"bad_type.onnx", "'x' is not a tensor of float32"});
}

TEST(Session, RefusesValuesThatAreNotFinite) {
  SSLCD_RUNTIME();
  const Session session(TestModel("bad_values.onnx"));
  EXPECT_EQ(session.Run({{"x", {{1, 2}, {1, 1}}}}).at("y").values, (std::vector<float>{0, 0}));
  ExpectError(
      [&] {
        session.Run({{"x", {{1, 2}, {1, -1}}}});
      },
      {"bad_values.onnx", "'y' holds NaN"});
  ExpectError([&] { session.Run({{"x", {{1, 2}, {1, 0}}}}); }, {"infinity"});
}

class Library : public testing::Test {
 protected:
  void SetUp() override { SSLCD_RUNTIME(); }
  static void Open(const std::string& library) {
    InferenceOptions options;
    options.library = library;
    Session(TestModel("yolo_v5.onnx"), options);
  }
};

TEST_F(Library, Missing) {
  ExpectError([] { Open("/nowhere/libonnxruntime.so"); },
              {"not found where 'library' says", "/nowhere/libonnxruntime.so", "install it",
               "SSLCD_ORT_LIB"});
}

TEST_F(Library, SomethingElse) {
  ExpectError([] { Open("libm.so.6"); }, {"libm.so.6", "is not ONNX Runtime"});
}

TEST_F(Library, TooOld) {
  ExpectError([] { Open(SSLCD_OLD_RUNTIME); },
              {"is ONNX Runtime 1.4.0, but 1.17 or later is needed"});
}

TEST_F(Library, FromTheEnvironment) {
  const char* before = std::getenv("SSLCD_ORT_LIB");
  const std::string kept = before ? before : "";
  ::setenv("SSLCD_ORT_LIB", "/nowhere/else.so", 1);
  ExpectError([] { Open(""); }, {"where SSLCD_ORT_LIB says", "/nowhere/else.so"});
  before ? ::setenv("SSLCD_ORT_LIB", kept.c_str(), 1) : ::unsetenv("SSLCD_ORT_LIB");
}

}  // namespace
}  // namespace sslcd
