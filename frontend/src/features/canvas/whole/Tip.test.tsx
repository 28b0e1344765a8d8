import { act } from '@testing-library/react';
import { expect, it } from 'vitest';
import type { Part } from '@/model/nested';
import { useLiveStore } from '@/store/project/live';
import { forgetEditor } from '../../../../harness/canvas';
import { show } from '../../../../harness/testing';
import type { Facts } from './facts';
import { Tip } from './Tip';

const fact = (id: string): Facts => ({
  id,
  key: `Main/${id}`,
  node: { type: 'Sleep', name: 'wait' },
  family: 'action',
  hasError: false,
  isSelected: false,
});
const parts: Part[] = [
  { id: 'a', box: { x: 10, y: 10, width: 50, height: 30 }, title: 14, level: 1, piece: null },
  { id: 'z', box: { x: 340, y: 260, width: 50, height: 30 }, title: 14, level: 1, piece: null },
];
const room = { width: 400, height: 300 };

it('says name, type and status, on the side where there is room', () => {
  forgetEditor();
  const { container, rerender } = show(<Tip fact={fact('a')} parts={parts} room={room} />);
  const tip = () => container.querySelector<HTMLElement>('[class*="tip"]');
  expect(tip()).toHaveTextContent('waitSleep');
  expect([tip()?.style.left, tip()?.style.right, tip()?.style.top]).toEqual(['10px', '', '30px']);
  act(() => useLiveStore.setState({ statuses: new Map([['Main/a', 'RUNNING']]) }));
  expect(tip()).toHaveTextContent('waitSleep · running');
  rerender(<Tip fact={fact('z')} parts={parts} room={room} />);
  expect([tip()?.style.left, tip()?.style.right, tip()?.style.bottom]).toEqual(['', '10px', '46px']);
  rerender(<Tip fact={fact('gone')} parts={parts} room={room} />);
  expect(tip()).toBeNull();
});
