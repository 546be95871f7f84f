// SPDX-License-Identifier: BSD-3-Clause

#include "Boundaries.h"

#include <string>

namespace boundaries
{

Points sampled(int count, const std::function<Vector3(double)>& curve)
{
  Points points(3, count);
  for (int i = 0; i < count; ++i)
  {
    points.col(i) = curve(static_cast<double>(i) / (count - 1));
  }
  return points;
}

Points line(const Vector3& from, const Vector3& to, int count)
{
  return sampled(count, [&](double t) -> Vector3 { return (1.0 - t) * from + t * to; });
}

Points reversed(const Points& points)
{
  return points.rowwise().reverse();
}

std::vector<Points> border(const std::function<Vector3(double, double)>& map, int nu, int nv)
{
  return { sampled(nu, [&](double s) { return map(s, 0.0); }),
    sampled(nv, [&](double t) { return map(1.0, t); }),
    sampled(nu, [&](double s) { return map(s, 1.0); }),
    sampled(nv, [&](double t) { return map(0.0, t); }) };
}

std::vector<Points> scalene_quad()
{
  const Vector3 c00(0.1, 0.0, 0.0), c10(3.0, 0.3, 0.2), c11(2.7, 2.2, -0.1), c01(-0.2, 1.4, 0.4);
  return { line(c00, c10, 7), line(c10, c11, 5), line(c01, c11, 6), line(c00, c01, 4) };
}

Points joined(const std::vector<Points>& parts)
{
  Eigen::Index count = 0;
  for (const Points& part : parts)
  {
    count += part.cols();
  }
  Points all(3, count);
  count = 0;
  for (const Points& part : parts)
  {
    all.middleCols(count, part.cols()) = part;
    count += part.cols();
  }
  return all;
}

Points loop_of(const std::vector<Points>& sides)
{
  const auto open = [](const Points& p) -> Points { return p.leftCols(p.cols() - 1); };
  return joined(
    { open(sides[0]), open(sides[1]), open(reversed(sides[2])), open(reversed(sides[3])) });
}

std::vector<Points> unit_square(int count)
{
  return border([](double s, double t) { return Vector3(s, t, 0.0); }, count, count);
}

void expect_same(const footpoint::Boundary& a, const footpoint::Boundary& b)
{
  for (int role = 0; role < 4; ++role)
  {
    ASSERT_EQ(a.sides[role].cols(), b.sides[role].cols()) << role;
    EXPECT_TRUE(a.sides[role] == b.sides[role]) << role;
    EXPECT_EQ(a.corner_gaps[role], b.corner_gaps[role]) << role;
  }
}

void expect_refused(const std::function<void()>& call, footpoint::BoundaryDefect defect,
  const std::string& message_part)
{
  try
  {
    call();
    FAIL() << "accepted; expected: " << message_part;
  }
  catch (const footpoint::BoundaryError& error)
  {
    EXPECT_EQ(static_cast<int>(error.defect()), static_cast<int>(defect)) << error.what();
    EXPECT_NE(std::string(error.what()).find(message_part), std::string::npos)
      << "got:      " << error.what() << "\nexpected: " << message_part;
  }
}

} // namespace boundaries
