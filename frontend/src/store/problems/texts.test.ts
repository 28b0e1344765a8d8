import { afterEach, expect, it } from 'vitest';
import { clearTextFindings, setTextFindings, useTextFindings } from './texts';

afterEach(clearTextFindings);

const found = { text: '{', errors: [] };

it('keeps findings by path until they are removed', () => {
  setTextFindings('errors', 'a.json', found);
  setTextFindings('linted', 'a.py', { text: '', findings: [] });
  expect(useTextFindings.getState().errors).toEqual({ 'a.json': found });
  setTextFindings('errors', 'a.json', null);
  expect(useTextFindings.getState()).toEqual({ errors: {}, linted: { 'a.py': { text: '', findings: [] } } });
});

it('stays the same object if nothing is removed', () => {
  const before = useTextFindings.getState();
  setTextFindings('errors', 'a.json', null);
  expect(useTextFindings.getState()).toBe(before);
});

it('forgets everything with the project', () => {
  setTextFindings('errors', 'a.json', found);
  clearTextFindings();
  expect(useTextFindings.getState()).toEqual({ errors: {}, linted: {} });
});
