import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { SourceView } from './SourceView';

it('shows a text with line numbers, which cannot be edited', () => {
  const { unmount } = show(<SourceView path="actions/Drive.py" text={'class Drive:\n    pass'} />);
  const text = screen.getByRole('textbox', { name: 'Source of actions/Drive.py' });
  expect(text).toHaveTextContent('class Drive: pass');
  expect(text).toHaveAttribute('contenteditable', 'false');
  expect(text).toHaveAttribute('tabindex', '0');
  const numbers = [...document.querySelectorAll('.cm-lineNumbers .cm-gutterElement')].map(
    (each) => each.textContent,
  );
  expect(numbers).toEqual(expect.arrayContaining(['1', '2']));
  unmount();
  expect(document.querySelector('.cm-editor')).toBeNull();
});
