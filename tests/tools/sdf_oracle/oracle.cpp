// Prints each model, link and light of SDF files with its pose in the world, as libsdformat resolves it.
#include <cstdio>
#include <iostream>
#include <string>
#include <ignition/math/Pose3.hh>
#include <sdf/sdf.hh>

using Pose = ignition::math::Pose3d;

static void print(const char *kind, const std::string &name, const Pose &p) {
  std::printf("%s\t%s\t%.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", kind, name.c_str(), p.Pos().X(), p.Pos().Y(),
              p.Pos().Z(), p.Rot().X(), p.Rot().Y(), p.Rot().Z(), p.Rot().W());
}

template <class T> static Pose resolved(const T &thing, const Pose &above) {
  Pose own;
  for (const auto &error : thing.SemanticPose().Resolve(own)) std::cerr << error.Message() << "\n";
  return above * own;
}

static void print_model(const sdf::Model &model, const std::string &path, const Pose &above) {
  const std::string name = path.empty() ? model.Name() : path + "::" + model.Name();
  const Pose pose = resolved(model, above);
  print("model", name, pose);
  for (uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link &link = *model.LinkByIndex(i);
    print("link", name + "::" + link.Name(), resolved(link, pose));
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i) print_model(*model.ModelByIndex(i), name, pose);
}

int main(int count, char **files) {
  sdf::addURIPath("model://", files[1]);
  for (int i = 2; i < count; ++i) {
    sdf::Root root;
    const auto errors = root.Load(files[i]);
    std::printf("file\t%s\t%zu\n", files[i], errors.size());
    for (const auto &error : errors) std::cerr << files[i] << ": " << error.Message() << "\n";
    for (uint64_t w = 0; errors.empty() && w < root.WorldCount(); ++w) {
      const sdf::World &world = *root.WorldByIndex(w);
      for (uint64_t m = 0; m < world.ModelCount(); ++m) print_model(*world.ModelByIndex(m), "", Pose::Zero);
      for (uint64_t l = 0; l < world.LightCount(); ++l)
        print("light", world.LightByIndex(l)->Name(), resolved(*world.LightByIndex(l), Pose::Zero));
    }
  }
}
