#include "ale/embed/layer_body.hpp"
#include "ale/embed/open_part.hpp"

namespace ballast {

template <> void LayerBody<3>::add_faces(const LayerStack<3>&, const std::vector<char>&, const std::vector<double>&) {}
template <> bool LayerBody<3>::foot(const std::array<double, 3>&, double, BodyFoot<3>&, int) const { return false; }
template <> bool LayerBody<3>::inside(const std::array<double, 3>&) const { return false; }
template <> LayerBody<3>::LayerBody(const LayerStack<3>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, double) { add_faces(stack, alive, least_thickness); }
template <> bool LayerBody<3>::near(const std::array<double, 3>&, double) const { return false; }
template <> OpenPart<3> open_part<3>(const LevelCell<3>&, bool) { return {}; }
template <> double open_swept<3>(const SweptFace<3>&, bool) { return 0; }
template <> double open_share<3>(const std::array<double, 4>&) { return 1; }
template <> double open_volume<3>(const LevelCell<3>&, bool) { return 0; }

} // namespace ballast
