// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/temp_folder.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using ::testing::HasSubstr;

struct Loop {
  double topology_m = 5;
  int neighbours = 3;
};
void DescribeFields(FieldVisitor& v, Loop& loop) {
  v.Real("topology_m", loop.topology_m, 0, 10, "how far neighbours are");
  v.Integer("neighbours", loop.neighbours, 1, 20, "K");
}
struct Lists {
  std::vector<double> weights{1, 2};
  std::map<int, std::string> names{{3, "three"}};
};
void DescribeFields(FieldVisitor& v, Lists& lists) {
  v.Numbers("weights", lists.weights, 0, 10, "how much each counts");
  v.Names("names", lists.names, "who is who");
}
Describe Of(Lists& lists) {
  return [&lists](FieldVisitor& v) { DescribeFields(v, lists); };
}
struct Root {
  enum class Mode { kFast, kSafe } mode = Mode::kFast;
  bool on = true;
  std::string name = "it's";
  Loop loop;
};
void DescribeFields(FieldVisitor& v, Root& root) {
  v.Enum("mode", root.mode, {"fast", "safe"}, "how");
  v.Flag("on", root.on, "whether");
  v.Text("name", root.name, "who");
  v.Nested("loop", root.loop, "loops");
}
Describe Of(Root& root) {
  return [&root](FieldVisitor& v) { DescribeFields(v, root); };
}

std::string ErrorOf(const std::string& yaml) {
  Root root;
  try {
    LoadConfigText(yaml, "c.yaml", Of(root));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadConfig);
    EXPECT_EQ(root.loop.topology_m, 5) << "a bad file must change nothing";
    EXPECT_EQ(root.loop.neighbours, 3);
    return error.what();
  }
  return "no error";
}

TEST(Config, LoadsWhatIsThereAndKeepsTheRest) {
  Root root;
  LoadConfigText("mode: safe\nloop:\n  topology_m: 2.5\n", "c.yaml", Of(root));
  EXPECT_EQ(root.mode, Root::Mode::kSafe);
  EXPECT_EQ(root.loop.topology_m, 2.5);
  EXPECT_EQ(root.loop.neighbours, 3);
  LoadConfigText("", "c.yaml", Of(root));
  LoadConfigText("loop:\n", "c.yaml", Of(root));
  EXPECT_EQ(root.loop.topology_m, 2.5);
}

TEST(Config, UnknownKeysAreSuggestedWithTheirPlace) {
  EXPECT_EQ(ErrorOf("on: true\nloop:\n  topolgy_m: 3\n"),
            "c.yaml:3:3: unknown key 'topolgy_m' in 'loop' - did you mean 'topology_m'?");
  EXPECT_EQ(ErrorOf("quite_else: 3\n"), "c.yaml:1:1: unknown key 'quite_else'");
  // two letters, or a third of them, may be wrong; the first of two names that are as near
  EXPECT_EQ(ErrorOf("mo: fast\n"), "c.yaml:1:1: unknown key 'mo' - did you mean 'mode'?");
  EXPECT_EQ(ErrorOf("nameee: x\n"), "c.yaml:1:1: unknown key 'nameee' - did you mean 'name'?");
  EXPECT_EQ(ErrorOf("nameeee: x\n"), "c.yaml:1:1: unknown key 'nameeee'");
}

TEST(Config, AllProblemsAtOnce) {
  const std::string text =
      ErrorOf("mode: slow\non: 1\nloop: {topology_m: 11, neighbours: 3.0, neighbours: 4}\n");
  EXPECT_THAT(text, HasSubstr("c.yaml:1:7: 'mode' is 'slow', must be one of fast, safe"));
  EXPECT_THAT(text, HasSubstr("c.yaml:2:5: 'on' is '1', must be true or false"));
  EXPECT_THAT(text, HasSubstr("c.yaml:3:20: 'topology_m' is 11, must be in [0, 10]"));
  EXPECT_THAT(text, HasSubstr("duplicate key 'neighbours' in 'loop'"));
  EXPECT_THAT(text, HasSubstr("'neighbours' is '3.0', must be a whole number"));
}

TEST(Config, WrongTypesAndSyntax) {
  EXPECT_THAT(ErrorOf("loop: {topology_m: two}\n"), HasSubstr("must be a number"));
  EXPECT_THAT(ErrorOf("loop: {topology_m: [1]}\n"), HasSubstr("must be a number"));
  EXPECT_THAT(ErrorOf("loop: {topology_m: }\n"), HasSubstr("is nothing, must be a number"));
  EXPECT_THAT(ErrorOf("loop: {topology_m: .nan}\n"), HasSubstr("must be"));
  EXPECT_THAT(ErrorOf("loop: {topology_m: nan}\n"), HasSubstr("must be in [0, 10]"));
  EXPECT_THAT(ErrorOf("loop: 5\n"), HasSubstr("'loop' is a section"));
  EXPECT_THAT(ErrorOf("- 1\n- 2\n"), HasSubstr("expected a map"));
  EXPECT_THAT(ErrorOf("on: true\nloop: {a: [}\n"), HasSubstr("c.yaml:2:"));
  EXPECT_THAT(ErrorOf("{}\n---\nloop: {}\n"), HasSubstr("c.yaml:2:1: a second document"));
  EXPECT_THAT(ErrorOf("{}\n...\nloop: [\n"), HasSubstr("c.yaml:"));
  EXPECT_THAT(ErrorOf(",, ]"), HasSubstr("c.yaml:1:")) << "documents without end";
}

TEST(Config, SettingsNameThemselves) {
  Root root;
  ApplySettings({"loop.topology_m=3", "mode=safe", "name=a=b"}, Of(root));
  EXPECT_EQ(root.loop.topology_m, 3);
  EXPECT_EQ(root.mode, Root::Mode::kSafe);
  EXPECT_EQ(root.name, "a=b");
  try {
    ApplySettings({"loop.neighbours=7", "loop.topolgy_m=3", "nonsense", "on=maybe"}, Of(root));
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(
        error.what(),
        HasSubstr("--set loop.topolgy_m=3: unknown key 'topolgy_m' in 'loop' - did you mean"));
    EXPECT_THAT(error.what(), HasSubstr("--set nonsense: expected key=value"));
    EXPECT_THAT(error.what(), HasSubstr("--set on=maybe: 'on' is 'maybe'"));
  }
  EXPECT_EQ(root.loop.neighbours, 3) << "one bad setting, and none is applied";
}

TEST(Config, DumpLoadsBackToTheBit) {
  Root root;
  root.loop.topology_m = 0.1 + 0.2;
  root.mode = Root::Mode::kSafe;
  for (const bool comments : {false, true}) {
    Root loaded;
    LoadConfigText(DumpConfig(Of(root), comments), "dump", Of(loaded));
    EXPECT_EQ(loaded.loop.topology_m, root.loop.topology_m);
    EXPECT_EQ(loaded.mode, root.mode);
    EXPECT_EQ(loaded.name, "it's");
  }
}

TEST(Config, ReferenceNamesEveryKey) {
  Root root;
  const std::string text = ConfigReference(Of(root));
  EXPECT_THAT(text, HasSubstr("| `topology_m` | number | 5 | 0 .. 10 | how far neighbours are |"));
  EXPECT_THAT(text, HasSubstr("## `loop`"));
}

TEST(Config, ListsAndNames) {
  Lists lists;
  LoadConfigText("weights: [0.5, 3e0, 10]\nnames: {0: a, 12: 'b c'}\n", "c.yaml", Of(lists));
  EXPECT_EQ(lists.weights, (std::vector<double>{0.5, 3, 10}));
  EXPECT_EQ(lists.names, (std::map<int, std::string>{{0, "a"}, {12, "b c"}}));
  Lists again;
  LoadConfigText(DumpConfig(Of(lists), true), "dump", Of(again));
  EXPECT_EQ(again.weights, lists.weights);
  EXPECT_EQ(again.names, lists.names);
  LoadConfigText("weights: []\nnames: {}\n", "c.yaml", Of(lists));
  EXPECT_TRUE(lists.weights.empty() && lists.names.empty());
  EXPECT_THAT(ConfigReference(Of(again)),
              HasSubstr("| `weights` | numbers | [0.5, 3, 10] | 0 .. 10 | how much"));
}

TEST(Config, BadListsAndNames) {
  Lists lists;
  const auto error_of = [&lists](const std::string& yaml) -> std::string {
    try {
      LoadConfigText(yaml, "c.yaml", Of(lists));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of("weights: 3"),
            "c.yaml:1:10: 'weights' is '3', must be a list of numbers, e.g. [1, 2]");
  EXPECT_EQ(error_of("weights: [1, 11]"), "c.yaml:1:14: 'weights' is 11, must be in [0, 10]");
  EXPECT_THAT(error_of("weights: [1, [2]]"), HasSubstr("c.yaml:1:14: 'weights' is a list or map"));
  EXPECT_THAT(error_of("weights: [1, .nan]"), HasSubstr("must be"));
  EXPECT_THAT(error_of("names: [a]"),
              HasSubstr("must be names by number, e.g. {2: Car, 7: Truck}"));
  EXPECT_THAT(error_of("names: {-1: a}"),
              HasSubstr("'names' has '-1', must be a whole number >= 0"));
  EXPECT_THAT(error_of("names: {1: [a]}"), HasSubstr("must be names by number"));
  EXPECT_THAT(error_of("names: {1: a, 01: b}"), HasSubstr("duplicate number 01 in 'names'"));
  EXPECT_EQ(lists.weights, (std::vector<double>{1, 2})) << "a bad file must change nothing";
}

TEST(Config, EverydayFieldsComeFirst) {
  double gain = 2, other = 3, deep = 4;
  const Describe fields = [&](FieldVisitor& v) {
    v.Real("other", other, 0, 10, "not of every day");
    v.Everyday("more: louder").Real("gain", gain, 0, 10, "the gain");
    v.Section("empty", "nothing of every day",
              [&](FieldVisitor& inner) { inner.Real("key", other, 0, 10, "k"); });
    v.Section("a", "section", [&](FieldVisitor& inner) {
      inner.Everyday("less: softer").Real("deep", deep, 0, 10, "the depth");
    });
  };
  EXPECT_EQ(DumpConfig(fields, false, true), "gain: 2\na:\n  deep: 4\n");
  EXPECT_EQ(DumpConfig(fields, false), "other: 3\ngain: 2\nempty:\n  key: 3\na:\n  deep: 4\n");
  const std::string text = ConfigReference(fields);
  EXPECT_LT(text.find("| `a.deep` | 4 | 0 .. 10 | the depth | less: softer |"),
            text.find("## All keys"));
  EXPECT_EQ(text.find("`other`"), text.rfind("`other`")) << "in the second part alone";
}

std::string ProblemsOf(const std::vector<FieldProblem>& problems, const std::string& path,
                       const std::vector<std::string>& settings) {
  try {
    ThrowProblems(problems, path, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadConfig);
    return error.what();
  }
  return "";
}

TEST(Config, ProblemsNameWhereTheirKeysAreGiven) {
  const TempFolder folder;
  const std::string path = folder.Write("problems.yaml", "loop:\n  neighbours: 7\n");
  const std::vector<FieldProblem> problems{{{"loop.topology_m", "loop.neighbours"}, "no fit"},
                                           {{"on"}, "must be off"}};
  EXPECT_EQ(ProblemsOf(problems, path, {}), path + ":2:15: no fit\non: must be off");
  EXPECT_EQ(ProblemsOf(problems, path, {"on=false", "loop.topology_m=2", "on=true"}),
            "--set loop.topology_m=2: no fit\n--set on=true: must be off");
  EXPECT_EQ(ProblemsOf(problems, "", {}), "loop.topology_m: no fit\non: must be off");
  EXPECT_EQ(ProblemsOf({}, path, {}), "");
}

TEST(Config, MissingFile) {
  Root root;
  EXPECT_THROW(LoadConfigFile("/nowhere/c.yaml", Of(root)), Error);
}

}  // namespace
}  // namespace sslcd
