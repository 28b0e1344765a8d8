import { screen, within } from '@testing-library/react';
import { expect, it } from 'vitest';
import { callOf } from '../../../../harness/tickSource';
import { show } from '../../../../harness/testing';
import { CallValues } from './CallValues';

it('shows the variables, the fields and what was returned', () => {
  show(<CallValues call={callOf()} />);
  const variables = screen.getByRole('table', { name: 'Variables at the end' });
  expect(within(variables).getByRole('row', { name: 'total 1' })).toBeInTheDocument();
  const fields = screen.getByRole('table', { name: 'Fields at the end' });
  expect(fields).toHaveTextContent('self.number66');
  expect(screen.getByText('Returned 1')).toBeInTheDocument();
});

it('shows an exception, and no empty table', () => {
  show(
    <CallValues call={callOf({ end: 'raised', result: 'ValueError: too far', locals: [], fields: [] })} />,
  );
  expect(screen.getByText('Raised ValueError: too far')).toBeInTheDocument();
  expect(screen.queryByRole('table')).toBeNull();
});
