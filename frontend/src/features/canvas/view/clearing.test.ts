import { describe, expect, it } from 'vitest';
import { panToShow } from './clearing';

const view = { x: 0, y: 0, width: 800, height: 600 };
const map = { x: 620, y: 480, width: 170, height: 110 };
const box = (x: number, y: number, width = 140, height = 44) => ({ x, y, width, height });

describe('the smallest pan that shows a block', () => {
  it.each([
    ['is none in the free part', box(100, 100), { dx: 0, dy: 0 }],
    ['brings it in from the left', box(-30, 100), { dx: 30, dy: 0 }],
    ['brings it in from below', box(100, 590), { dx: 0, dy: -34 }],
    ['brings it in from the right', box(700, 100), { dx: -40, dy: 0 }],
    ['moves it above the overview', box(640, 460), { dx: 0, dy: -36 }],
    ['moves it beside the overview', box(500, 540), { dx: -32, dy: 0 }],
    ['moves one that is outside past the overview', box(640, 620), { dx: 0, dy: -196 }],
    ['shows the start of one that is too large', box(100, 100, 900), { dx: -100, dy: 0 }],
  ])('%s', (_name, block, pan) => {
    expect(panToShow(block, view, [map])).toEqual(pan);
  });

  it('avoids several obstacles', () => {
    const bar = { x: 0, y: 540, width: 560, height: 50 };
    const { dx, dy } = panToShow(box(500, 520), view, [map, bar]);
    expect({ dx, dy }).toEqual({ dx: 0, dy: -96 });
  });

  it('only brings it into view if nothing is free', () => {
    expect(panToShow(box(100, 100, 700, 500), view, [map])).toEqual({ dx: 0, dy: 0 });
  });
});
