import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { show } from '../../../harness/testing';
import { Stacks } from './Stacks';

it('has the twenty most frequent stacks with their shares', () => {
  const stacks = Array.from({ length: 30 }, (_, index) => ({ frames: [`f${index}`], samples: 30 - index }));
  show(<Stacks name="Go" samples={60} stacks={stacks} />);
  const items = screen.getAllByRole('listitem');
  expect(items).toHaveLength(20);
  expect(items[0]).toHaveTextContent('50 % f0');
});

it('says that nothing was seen yet', () => {
  show(<Stacks name="Go" samples={0} stacks={[]} />);
  expect(screen.getByText(/^0 samples/)).toBeVisible();
  expect(screen.queryAllByRole('listitem')).toEqual([]);
});
