import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import type { Part } from '@/model/nested';
import { show } from '../../../../harness/testing';
import type { Facts } from './facts';
import { PartBox } from './PartBox';

const box = { x: 10, y: 20, width: 100, height: 60 };
const part: Part = { id: 'r', box, title: 20, level: 2, piece: null };
const fact: Facts = {
  id: 'r',
  key: 'Main/r',
  node: { type: 'Sequence', name: 'patrol', color: '#123456' },
  family: 'control',
  hasError: false,
  isSelected: true,
};

it('has its place, its name and its looks', () => {
  show(<PartBox part={part} fact={fact} facts={new Map()} mark={undefined} hits={new Set()} isLeaf />);
  const item = screen.getByRole('treeitem', { name: 'patrol', selected: true });
  expect(item).toHaveStyle({ left: '10px', top: '20px', width: '100px', height: '60px' });
  expect(item.style.getPropertyValue('--family')).toBe('#123456');
  expect(item).toHaveAttribute('aria-level', '2');
  expect(item).toHaveAttribute('data-family', 'control');
  expect(item.querySelector('svg')).not.toBeNull();
  expect(item.querySelector('[data-piece]')).toBeNull();
});

it('leaves the symbol out where a name has no room beside it', () => {
  const narrow = { ...part, box: { ...box, width: 50 } };
  show(<PartBox part={narrow} fact={fact} facts={new Map()} mark={undefined} hits={new Set()} isLeaf />);
  expect(screen.getByRole('treeitem').querySelector('svg')).toBeNull();
});
