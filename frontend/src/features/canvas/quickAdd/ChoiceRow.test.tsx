import { fireEvent, screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { vocabulary } from '@/model/testing';
import { show } from '../../../../harness/testing';
import { ChoiceRow } from './ChoiceRow';

const spec = vocabulary.specs.get('Sequence')!;
const choice = { kind: { type: 'Sequence' }, spec, label: 'Sequence' };

it('shows the choice, its description, and whether it is active', () => {
  show(<ChoiceRow id="one" choice={choice} isActive onChoose={() => undefined} />);
  show(<ChoiceRow id="two" choice={choice} isActive={false} onChoose={() => undefined} />);
  const [one, two] = screen.getAllByRole('option');
  expect(one).toHaveAttribute('id', 'one');
  expect(one).toHaveAttribute('aria-selected', 'true');
  expect(two).toHaveAttribute('aria-selected', 'false');
  expect(one).toHaveTextContent(`Sequence${spec.summary}`);
});

it('is chosen before the search box loses the focus', () => {
  const onChoose = vi.fn();
  show(<ChoiceRow id="one" choice={choice} isActive onChoose={onChoose} />);
  // False: the default action, which moves the focus, was prevented.
  expect(fireEvent.pointerDown(screen.getByRole('button'))).toBe(false);
  expect(onChoose).toHaveBeenCalledOnce();
});
