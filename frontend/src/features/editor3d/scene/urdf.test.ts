import { describe, expect, it } from 'vitest';
import type { Shape } from '@/generated/messages';
import { urdfShapes } from './urdf';

const robot = (inside: string) => `<robot name="r">${inside}</robot>`;
const link = (name: string, inside = '') => `<link name="${name}">${inside}</link>`;
const visual = (geometry: string, more = '') => `<visual>${more}<geometry>${geometry}</geometry></visual>`;
const joint = (parent: string, child: string, origin = '') =>
  `<joint name="${parent}_${child}"><parent link="${parent}"/><child link="${child}"/>${origin}</joint>`;
const BOX = '<box size="1 2 3"/>';

const rounded = (shape: Shape): Shape => ({
  ...shape,
  pose: shape.pose.map((part) => Math.round(part * 1e4) / 1e4 + 0),
});
const shapes = (text: string) => urdfShapes(text)!.map(rounded);
const HERE = [0, 0, 0, 0, 0, 0, 1];
const GREY = [0.6, 0.62, 0.66, 1];

describe('urdfShapes', () => {
  it.each(['', '<robot>', '<model/>', 'no xml'])(
    'returns nothing for a text that is not a URDF: %s',
    (text) => {
      expect(urdfShapes(text)).toBeNull();
    },
  );

  it.each([
    [BOX, { shape: 'box', size: [1, 2, 3] }],
    ['<cylinder radius="0.2" length="0.5"/>', { shape: 'cylinder', size: [0.2, 0.5] }],
    ['<capsule radius="0.2" length="0.5"/>', { shape: 'capsule', size: [0.2, 0.5] }],
    ['<sphere radius="0.3"/>', { shape: 'sphere', size: [0.3] }],
    ['<mesh filename="a.stl" scale="2 2 2"/>', { shape: 'mesh', size: [2, 2, 2], mesh: 'a.stl' }],
    ['<mesh filename="a.stl"/>', { shape: 'mesh', size: [1, 1, 1], mesh: 'a.stl' }],
    ['<box size="1 2"/>', { shape: 'box', size: [0.1, 0.1, 0.1] }],
    ['<sphere radius="wide"/>', { shape: 'sphere', size: [0.1] }],
  ])('reads %s', (geometry, shape) => {
    expect(shapes(robot(link('base', visual(geometry))))).toEqual([{ ...shape, pose: HERE, color: GREY }]);
  });

  it('leaves out unknown shapes', () => {
    expect(shapes(robot(link('base', `${visual('<cone/>')}<visual/>${visual('')}`)))).toEqual([]);
    expect(shapes(robot(link('base', '<collision><geometry><box/></geometry></collision>')))).toEqual([]);
  });

  it('adds up the joints above a link, and the origin of the shape', () => {
    const turn = '<origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/>';
    const text = robot(
      [
        link('base'),
        link('arm'),
        link('hand', visual(BOX, '<origin xyz="0 0 0.5"/>')),
        joint('base', 'arm', turn),
        joint('arm', 'hand', '<origin xyz="2 0 0"/>'),
      ].join(''),
    );
    expect(shapes(text)[0]?.pose).toEqual([1, 2, 0.5, 0, 0, 0.7071, 0.7071]);
  });

  it('turns by roll, then pitch, then yaw, about fixed axes', () => {
    const quarter = Math.PI / 2;
    const text = robot(link('base', visual(BOX, `<origin rpy="${quarter} 0 ${quarter}"/>`)));
    expect(shapes(text)[0]?.pose).toEqual([0, 0, 0, 0.5, 0.5, 0.5, 0.5]);
  });

  it('takes colours from the shape, from the robot by name, or a grey', () => {
    const red = '<color rgba="1 0 0 1"/>';
    const text = robot(
      [
        `<material name="red">${red}</material><material name="plain"/>`,
        link(
          'base',
          [
            visual(BOX, '<material name="red"/>'),
            visual(BOX, '<material name="red"><color rgba="0 1 0 0.5"/></material>'),
            visual(BOX, '<material name="other"/>'),
            visual(BOX, '<material name="plain"/>'),
            visual(BOX),
          ].join(''),
        ),
      ].join(''),
    );
    expect(shapes(text).map(({ color }) => color)).toEqual([[1, 0, 0, 1], [0, 1, 0, 0.5], GREY, GREY, GREY]);
  });

  it('ends even if links form a cycle', () => {
    const text = robot(
      [
        link('root', visual(BOX)),
        link('a'),
        link('b'),
        joint('root', 'a'),
        joint('a', 'b'),
        joint('b', 'a'),
      ].join(''),
    );
    expect(shapes(text)).toHaveLength(1);
  });
});
