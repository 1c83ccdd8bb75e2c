#include <adit/io/carmen.hpp>
#include <adit/io/plan.hpp>
#include <adit/localizer/localizer.hpp>
#include <cstdio>

int main(int, char** argv) {
  const adit::Plan plan = adit::read_plan(argv[1]).value();
  const adit::Log log = adit::read_log(argv[2]).value();

  const adit::LineMap map = adit::LineMap::build(plan.segments);
  adit::Localizer localizer(map, {});
  localizer.start({.x = 2.0, .y = 2.0, .theta = 0.3});
  for (const adit::LogScan& scan : log.scans) {
    const adit::Estimate& now = localizer.update(scan.scan, scan.odom_from_vehicle);
    std::printf("%.3f: x %.3f m, y %.3f m, heading %.3f rad, %s\n", now.stamp, now.pose.x,
                now.pose.y, now.pose.theta, adit::to_string(now.status));
  }
}
