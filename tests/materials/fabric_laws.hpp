// The fabric laws that the tests of the fabric share.
#pragma once

#include "materials/fabric_library.hpp"

#include <string>
#include <vector>

namespace ballast::fabric_laws {

inline RaftenbergFabric paper() { return std::get<RaftenbergFabric>(find_fabric("kevlar_km2_raftenberg")->model); }

struct Named {
  std::string name;
  FabricModel model;
  bool kinked = false; ///< corners within the strains that tests visit
  bool solid = false;  ///< with the solid hand-over
};

/// Every law and option that derives from a potential.
inline std::vector<Named> elastic_laws() {
  std::vector<Named> all = {{"printed", paper()}, {"hooke", find_fabric("kevlar_hooke_wstm")->model}};
  RaftenbergFabric law = paper();
  law.form = TransverseForm::a;
  all.push_back({"form A", law});
  law.form = TransverseForm::c;
  all.push_back({"form C", law});
  law = paper();
  law.solid = SolidHandOver{};
  all.push_back({"solid", law, true, true});
  law = paper();
  law.in_plane = law.through = awg_shear();
  all.push_back({"locking shear", law, true});
  law = paper();
  law.in_plane.modulus = 10e6, law.through.modulus = 20e6;
  all.push_back({"low shear", law});
  law = paper();
  law.warp.unload = law.fill.unload = 0.05;
  all.push_back({"short ramp", law});
  law = paper();
  law.coupling = 2e11;
  all.push_back({"coupled", law});
  law.solid = SolidHandOver{};
  law.in_plane = awg_shear();
  law.form = TransverseForm::a;
  all.push_back({"all elastic options", law, true, true});
  return all;
}

} // namespace ballast::fabric_laws
