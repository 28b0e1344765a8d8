import { describe, expect, it } from 'vitest';
import { isInside, pictureFrame } from './pictureFrame';

const box = (x: number, y: number) => ({ x, y, width: 100, height: 40 });

describe('pictureFrame', () => {
  it('shows all of a small tree, with a margin', () => {
    const frame = pictureFrame([box(0, 0), box(200, 100)], box(0, 0), true);
    expect(frame).toEqual({ x: -16, y: -16, width: 332, height: 172, cropped: null });
  });

  it('shows the top of a wide tree, with the root in the middle', () => {
    const root = box(4950, 0);
    const frame = pictureFrame([root, box(0, 100), box(9900, 100)], root, true);
    expect(frame).toMatchObject({ y: -16, height: 172, width: 1500, cropped: 'bottom' });
    expect(frame.x + frame.width / 2).toBe(5000);
  });

  it('shows the beginning of a tall tree that grows to the right', () => {
    const root = box(0, 0);
    const frame = pictureFrame([root, box(200, 5000)], root, false);
    expect(frame).toMatchObject({ x: -16, y: -16, height: 720, cropped: 'right' });
  });

  it('tells whether a block is inside', () => {
    const frame = box(0, 0);
    expect([box(99, 39), box(100, 0), box(-100, 0), box(0, 40)].map((each) => isInside(frame, each))).toEqual(
      [true, false, false, false],
    );
  });
});
