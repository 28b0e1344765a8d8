import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { callOf, sourceOf } from '../../../../harness/tickSource';
import { show } from '../../../../harness/testing';
import { RanCode } from './RanCode';

it('shows the file as it ran, which cannot be edited', () => {
  const call = callOf();
  show(<RanCode source={sourceOf({ calls: [call] })} call={call} />);
  const text = screen.getByRole('textbox', { name: 'actions/Forward.py as it ran' });
  expect(text).toHaveAttribute('aria-readonly', 'true');
  expect(text).toHaveTextContent('self.number += 1self.number = 66');
});

it('says that a text is missing', () => {
  show(<RanCode source={sourceOf({ files: {} })} call={callOf()} />);
  expect(screen.getByText(/actions\/Forward.py is too long/)).toBeInTheDocument();
});
