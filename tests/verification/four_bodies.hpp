#pragma once
/// Inputs in which much happens at once.

#include <fmt/format.h>

#include <string>

namespace crampon::test {

/// Four bodies of two materials that collide about one point, with cracks through them.
inline std::string four_bodies(const std::string& contact, const std::string& method, int cracks, const std::string& law,
                               const std::string& more = "") {
  static const char* points[3] = {"[0.081, 0.1213], [0.279, 0.1187]", "[0.1993, 0.065], [0.2007, 0.195]", "[0.13, 0.06], [0.27, 0.19]"};
  std::string text = fmt::format(R"(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [0.4, 0.24]
cell = 0.01
[time]
steps = 60
courant = 0.3
[method]
{}
[contact]
fields = "bodies"
{}
[[material]]
name = "soft"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
[[material]]
name = "hard"
law = "elastic_large_rotation"
E = 4e6
nu = 0.2
density = 2500
[[body]]
name = "left"
material = "soft"
shape = {{ kind = "rectangle", low = [0.1, 0.08], high = [0.2, 0.16] }}
velocity = [2, 0.3]
[[body]]
name = "right"
material = "hard"
shape = {{ kind = "disk", centre = [0.25, 0.105], radius = 0.043 }}
velocity = [-3, 0]
[[body]]
name = "top"
material = "hard"
shape = {{ kind = "disk", centre = [0.213, 0.192], radius = 0.033 }}
velocity = [0, -3]
[[body]]
name = "small"
material = "soft"
shape = {{ kind = "rectangle", low = [0.2, 0.15], high = [0.23, 0.16] }}
velocity = [0.5, 0]
)",
                                 method, contact);
  for (int k = 0; k < cracks; ++k) text += fmt::format("[[crack]]\npoints = [{}]\ncontact = {}\n", points[k], law);
  return text + more;
}

/// Contact laws of every kind, rigid bodies, walls, interfaces that fail and cohesion at once.
inline std::string everything(const std::string& shape_functions) {
  return four_bodies(R"in(
default = { law = "slip_weakening", friction = 0.1, static_friction = 0.5, distance = 0.001 }
)in",
                     "shape_functions = \"" + shape_functions + "\"\nbody_force = [0, -10]", 2, "{ law = \"coulomb\", friction = 0.3 }",
                     R"in(
[crack.traction]
law = "triangular"
normal = { strength = 1e4, toughness = 2, stiffness = 1e8 }
shear = { strength = 1e4, toughness = 2, stiffness = 1e8 }
[[contact_pair]]
between = ["left", "right"]
contact = { law = "interface", tension = 1e8, tangential = 1e8, normal_strength = 3e4, shear_strength = 3e4, friction = 0.2 }
[[contact_pair]]
between = ["top", "right"]
contact = { law = "adhesive", shear_strength = 1e3, normal_strength = 1e3, friction = 0.2 }
[[rigid]]
name = "ram"
shape = { kind = "disk", centre = [0.0635, 0.12], radius = 0.035 }
velocity = [7, 0]
spin = [40]
[[rigid]]
name = "clamp"
shape = { kind = "rectangle", low = [0.28, 0.08], high = [0.31, 0.12] }
velocity = [-1, 0]
role = "boundary"
[[wall]]
name = "floor"
kind = "half_space"
point = [0, 0.088]
normal = [0.1, 1]
velocity = [0, 0.5]
)in");
}

}  // namespace crampon::test
