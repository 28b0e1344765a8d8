import { expect, it } from 'vitest';
import { DEFAULT_DISTRO, ROS_DISTROS, titled } from './rosDistros';

it('writes a distribution as its users do', () => {
  expect(ROS_DISTROS.map(titled)).toEqual(['Humble', 'Jazzy', 'Kilted', 'Lyrical']);
  expect(titled(DEFAULT_DISTRO)).toBe('Jazzy');
});
