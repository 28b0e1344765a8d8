import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { Legend } from './Legend';

it('names each status beside its colour', () => {
  const { container } = show(<Legend />);
  const swatches = [...container.querySelectorAll('[data-status]')];
  expect(
    swatches.map((swatch) => [swatch.getAttribute('data-status'), swatch.parentElement?.textContent]),
  ).toEqual([
    ['RUNNING', 'running'],
    ['SUCCESS', 'success'],
    ['FAILURE', 'failure'],
    ['SKIPPED', 'skipped'],
  ]);
});
