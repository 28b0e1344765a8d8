import { describe, expect, it } from 'vitest';
import { personShapes } from './person';

const color = [0.5, 0.25, 1, 1];

describe('personShapes', () => {
  const shapes = personShapes(color);
  /** Returns the lowest and the highest point of an upright shape along z. */
  const reach = ({ shape, size, pose }: (typeof shapes)[number]): [number, number] => {
    const [a = 0, b = 0, c = 0] = size;
    const isLevel = pose[3] !== 0;
    const half =
      shape === 'capsule'
        ? isLevel
          ? a
          : b / 2 + a
        : shape === 'box'
          ? c / 2
          : shape === 'sphere'
            ? a
            : b / 2;
    return [pose[2]! - half, pose[2]! + half];
  };

  it('stand on the floor, 1.75 m tall', () => {
    expect(Math.min(...shapes.map((shape) => reach(shape)[0]))).toBeCloseTo(0, 6);
    expect(Math.max(...shapes.map((shape) => reach(shape)[1]))).toBeCloseTo(1.75, 1);
  });

  it('have a left side that mirrors the right one', () => {
    const sided = shapes.filter(({ pose }) => pose[1] !== 0);
    expect(sided).toHaveLength(14);
    for (const { shape, size, pose } of sided) {
      const across = { shape, size, pose: pose.map((part, at) => (at === 1 ? -part : part)) };
      expect(sided).toContainEqual(expect.objectContaining(across));
    }
    expect(shapes).toHaveLength(20);
  });

  it('have the colour, and darker trousers', () => {
    const colors = shapes.map((shape) => shape.color.map((part) => Math.round(part * 100) / 100));
    expect(colors.filter((each) => each.join() === '0.5,0.25,1,1')).toHaveLength(7);
    expect(colors.filter((each) => each.join() === '0.4,0.2,0.8,1')).toHaveLength(5);
  });

  it('look along x: the nose is in front, and the shoes point there', () => {
    const nose = shapes.at(-1)!;
    expect(nose.pose.slice(0, 3)).toEqual([0.098, 0, 1.605]);
    const shoes = shapes.filter(({ shape }) => shape === 'box');
    expect(shoes.map(({ pose }) => pose[0])).toEqual([0.045, 0.045]);
  });
});
