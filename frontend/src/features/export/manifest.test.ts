import { expect, it } from 'vitest';
import { dependenciesOf, PACKAGE_NAME } from './manifest';

it('lists what a package needs to run, sorted, each once', () => {
  const manifest = `<?xml version="1.0"?>
    <package format="3">
      <depend> rclpy </depend>
      <exec_depend>geometry_msgs</exec_depend>
      <exec_depend>rclpy</exec_depend>
      <exec_depend></exec_depend>
      <test_depend>pytest</test_depend>
      <buildtool_depend>ament_cmake</buildtool_depend>
    </package>`;
  expect(dependenciesOf(manifest)).toEqual(['geometry_msgs', 'rclpy']);
});

it.each([
  ['bump_and_go', true],
  ['a', true],
  ['a1_b2', true],
  ['', false],
  ['1a', false],
  ['A', false],
  ['a__b', false],
  ['a_', false],
  ['_a', false],
  ['a-b', false],
])('accepts %s as the name of a package: %s', (name, isName) => {
  expect(PACKAGE_NAME.test(name)).toBe(isName);
});
