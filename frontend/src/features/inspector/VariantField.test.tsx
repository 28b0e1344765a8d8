import { screen } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import { shownTarget } from '../../../harness/target';
import { nodeOf, openProject, show, user } from '../../../harness/testing';
import { VariantField } from './VariantField';

const Field = shownTarget('Main', VariantField);

beforeEach(() => {
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['s', 'l'] },
        s: { type: 'Switch3', name: 'Which', ports: { variable: '{x}', case_1: 'a', case_3: 'c' } },
        l: { type: 'LoopInt', ports: { queue: '1;2' } },
      },
    },
  });
});

it('changes the number of cases, and keeps name and ports that stay', async () => {
  show(<Field id="s" />);
  const cases = screen.getByRole('combobox', { name: 'Cases' });
  expect(cases).toHaveValue('Switch3');
  await user.selectOptions(cases, '2');
  expect(nodeOf('Main', 's')).toEqual({
    ...{ type: 'Switch2', name: 'Which' },
    ports: { variable: '{x}', case_1: 'a' },
  });
});

it('changes what a loop takes', async () => {
  show(<Field id="l" />);
  await user.selectOptions(screen.getByRole('combobox', { name: 'Elements' }), 'number');
  expect(nodeOf('Main', 'l')).toEqual({ type: 'LoopDouble', ports: { queue: '1;2' } });
});

it('is not there for other blocks', () => {
  show(<Field id="r" />);
  expect(screen.queryByRole('combobox')).toBeNull();
});
