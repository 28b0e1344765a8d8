import { act } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { showInFlow } from '../../../../harness/canvas';
import { Dots } from './Dots';

let moveTo: (x: number, y: number, zoom: number) => void;
const style = () => document.querySelector<HTMLElement>('[class*=dots]')!.style;

beforeEach(() => {
  const { store } = showInFlow(<Dots />);
  moveTo = (...transform) => act(() => store.setState({ transform }));
});

describe('Dots', () => {
  it('follow the view', () => {
    expect(style().backgroundSize).toBe('24px 24px');
    expect(style().backgroundPosition).toBe('-12px -12px');
    expect(style().getPropertyValue('--dot')).toBe('0.8px');
    moveTo(100, 50, 2);
    expect(style().backgroundSize).toBe('48px 48px');
    expect(style().backgroundPosition).toBe('76px 26px');
    expect(style().getPropertyValue('--dot')).toBe('1.6px');
    moveTo(0, 0, 2);
    expect(style().backgroundPosition).toBe('-24px -24px');
  });

  it.each([
    [0.5, 12],
    [0.49, 23.52],
    [0.25, 12],
    [0.1, 19.2],
  ])('are never closer than twelve pixels: at a zoom of %s they are %s', (zoom, gap) => {
    moveTo(0, 0, zoom);
    expect(parseFloat(style().backgroundSize)).toBeCloseTo(gap);
    expect(style().getPropertyValue('--dot')).toBe('0.5px');
  });
});
