import { cleanup, screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { PartMissing } from '@/ui/parts';
import { show } from '../../harness/testing';
import { ErrorBoundary } from './ErrorBoundary';

function Broken({ error }: { error: Error }): never {
  throw error;
}

/** Shows a part that fails; React writes the error to the console. */
function fail(error: Error) {
  const report = vi.spyOn(console, 'error').mockImplementation(() => undefined);
  show(
    <ErrorBoundary>
      <Broken error={error} />
    </ErrorBoundary>,
  );
  report.mockRestore();
}

it('shows its contents', () => {
  show(<ErrorBoundary>Fine</ErrorBoundary>);
  expect(screen.getByText('Fine')).toBeInTheDocument();
  expect(screen.queryByRole('alert')).toBeNull();
});

it('shows an internal error and the way to continue', () => {
  fail(new Error('x is undefined'));
  expect(screen.getByRole('alert')).toHaveTextContent('x is undefined');
  expect(screen.getByRole('button')).toBeEnabled();
});

it('tells a part that did not load from an internal error', () => {
  fail(new Error('x'));
  const crash = screen.getByRole('heading').textContent;
  cleanup();
  fail(new PartMissing('Editor'));
  expect(screen.getByRole('heading').textContent).not.toBe(crash);
});
