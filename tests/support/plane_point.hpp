#pragma once

namespace endowire::test {

struct PlanePoint {
  double x = 0.0;
  double y = 0.0;
};

}  // namespace endowire::test
