#include "ale/embed/body.hpp"
#include "ale/embed/open_part.hpp"

namespace ballast {

template <> void Body<3>::add_faces(const LayerStack<3>&, double) {}
template <> bool Body<3>::foot(const std::array<double, 3>&, double, BodyFoot<3>&, int) const { return false; }
template <> bool Body<3>::inside(const std::array<double, 3>&) const { return false; }
template <> Body<3>::Body(const LayerStack<3>& stack, double least_thickness, double) { add_faces(stack, least_thickness); }
template <> OpenPart<3> open_part<3>(const LevelCell<3>&, bool) { return {}; }
template <> double open_volume<3>(const LevelCell<3>&, bool) { return 0; }

} // namespace ballast
