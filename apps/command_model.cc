// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "detectors/layout_offers.h"
#include "examples.h"
#include "formats/atomic_file.h"
#include "formats/files.h"
#include "formats/json_text.h"
#include "sslcd/core/error.h"

namespace sslcd::apps {
namespace {

namespace fs = std::filesystem;

struct ModelArguments {
  std::string file, out, layout;
  int width_px = 0, height_px = 0;
  bool force = false, json = false;
};

void AddOptions(CLI::App& command, ModelArguments& a) {
  command.add_option("FILE", a.file, "an .onnx file")->required();
  command.add_option("--out", a.out, "description to write, .yaml");
  command.add_option("--layout", a.layout, "write this layout, where several fit");
  const CLI::Range side(1, kLargestInput);
  command.add_option("--width", a.width_px, "of models that take images of any size [px]")
      ->check(side);
  command.add_option("--height", a.height_px, "likewise [px]")->check(side);
  command.add_flag("--force", a.force, "write over a description");
  command.add_flag("--json", a.json, "print what was found as JSON and nothing else");
}

std::string TensorsText(const ModelFacts& facts) {
  std::vector<std::vector<std::string>> rows;
  for (const TensorInfo& info : facts.inputs)
    rows.push_back({"input " + Printable(info.name), info.type, ToString(info.shape)});
  for (std::size_t i = 0; i < facts.outputs.size(); ++i)
    rows.push_back({"output " + Printable(facts.outputs[i].name), facts.outputs[i].type,
                    ToString(facts.answers[i].shape)});
  return AlignedTable(rows);
}

std::string OffersText(const ModelFacts& facts, const std::vector<LayoutOffer>& offers) {
  std::string text;
  for (const LayoutOffer& offer : offers) {
    const ModelOutput& output = offer.description.output;
    text += "\nfits layout " + NameOf(output.layout);
    if (!offer.exact) text += " by the number of columns only";
    text += "; assumed:\n";
    for (const std::string& assumption : offer.assumptions) text += "  " + assumption + "\n";
    for (const auto& [number, label] : output.labels) {
      const auto name = facts.class_names.find(number);
      text += "  class " + std::to_string(number) +
              (name == facts.class_names.end() ? "" : " (" + Printable(name->second) + ")") +
              " -> " + label + "\n";
    }
  }
  return text;
}

std::string OffersJson(const ModelFacts& facts, const std::vector<LayoutOffer>& offers) {
  nlohmann::ordered_json root;
  const auto tensors = [](const std::vector<TensorInfo>& infos) {
    auto list = nlohmann::ordered_json::array();
    for (const TensorInfo& info : infos)
      list.push_back({{"name", info.name}, {"type", info.type}, {"shape", info.shape}});
    return list;
  };
  root["inputs"] = tensors(facts.inputs);
  root["outputs"] = tensors(facts.outputs);
  root["layouts"] = nlohmann::ordered_json::array();
  for (const LayoutOffer& offer : offers)
    root["layouts"].push_back({{"layout", NameOf(offer.description.output.layout)},
                               {"exact", offer.exact},
                               {"assumed", offer.assumptions}});
  return JsonText(root, root["layouts"]);
}

/// The offer to write. Throws Error(kUsage) if the layouts leave a choice.
LayoutOffer ChooseOffer(const ModelArguments& a, const std::vector<LayoutOffer>& offers) {
  std::vector<std::string> names;
  for (const LayoutOffer& offer : offers) {
    names.push_back(NameOf(offer.description.output.layout));
    if (names.back() == a.layout) return offer;
  }
  if (!a.layout.empty())
    throw Error(ErrorKind::kUsage, {a.file},
                "does not fit layout '" + a.layout + "', but " + Join(names));
  if (offers.size() > 1)
    throw Error(ErrorKind::kUsage, {a.file},
                "fits several layouts: choose one with --layout: " + Join(names));
  return offers.front();
}

void WriteDescription(const ModelArguments& a, LayoutOffer offer) {
  if (fs::path(a.out).extension() != ".yaml" && fs::path(a.out).extension() != ".yml")
    throw Error(ErrorKind::kUsage, a.out + ": the name of a description ends with .yaml");
  if (fs::exists(a.out) && !a.force)
    throw Error(ErrorKind::kUsage, a.out + ": is there already: write elsewhere, or --force");
  const fs::path folder = fs::absolute(a.out).parent_path();
  offer.description.file = fs::proximate(fs::absolute(a.file), folder).string();
  WriteFileAtomically(a.out, DescriptionText(offer));
}

int Inspect(const ModelArguments& a, const Console& console) {
  const ModelFacts facts = InspectModel(a.file, a.width_px, a.height_px, InferenceOptions());
  const std::vector<LayoutOffer> offers = OfferLayouts(facts);
  if (offers.empty())
    throw Error(ErrorKind::kBadInput, {a.file},
                "fits no layout. It has\n" + TensorsText(facts) + "\nthe layouts are" +
                    LayoutsAndShapes() + "\nExport the model with other outputs (docs/models.md)");
  if (!a.layout.empty()) ChooseOffer(a, offers);  // refuses one that does not fit
  if (a.json) std::fputs(OffersJson(facts, offers).c_str(), stdout);
  console.Say(TensorsText(facts) + "\n" + OffersText(facts, offers));
  if (a.out.empty()) {
    console.Say("write a description: sslcd_run model inspect " + a.file + " --out " +
                fs::path(a.file).stem().string() + ".yaml" +
                (a.layout.empty() ? "" : " --layout " + a.layout));
    return 0;
  }
  WriteDescription(a, ChooseOffer(a, offers));
  console.Say("wrote " + a.out + "; look at what it finds: sslcd_run detect IMAGES --detector " +
              a.out + " --overlays --out found");
  return 0;
}

}  // namespace

Command AddModelCommand(CLI::App& app, Console& console) {
  CLI::App* model = app.add_subcommand("model", "look into networks");
  model->require_subcommand(1);
  model->footer(Examples({"model inspect yolo11s.onnx"}));
  CLI::App* command = model->add_subcommand(
      "inspect", "print a network's inputs and outputs, and write a description that fits them");
  const auto a = std::make_shared<ModelArguments>();
  AddOptions(*command, *a);
  command->add_flag("-q,--quiet", console.quiet, "print errors only");
  command->footer(
      Examples({"model inspect yolo11s.onnx", "model inspect yolox.onnx --out yolox.yaml",
                "model inspect any_size.onnx --width 1248 --height 384"}));
  return [a, &console] {
    if (a->json) console.quiet = true;
    console.InstallLog();
    return Inspect(*a, console);
  };
}

}  // namespace sslcd::apps
