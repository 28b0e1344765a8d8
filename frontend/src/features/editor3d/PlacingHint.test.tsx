import { act, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { openUniverse } from '../../../harness/documents';
import { show } from '../../../harness/testing';
import { PlacingHint } from './PlacingHint';

it('says how a thing is placed, as long as one is', () => {
  const editor = openUniverse();
  show(<PlacingHint editor={editor} />);
  expect(screen.getByTestId('placing')).toBeEmptyDOMElement();
  act(() => editor.store.setState({ placing: { name: 'Crate', what: {} } }));
  expect(screen.getByTestId('placing')).toHaveTextContent(
    /^Click to place it, or Shift-click to place several: Crate\..*Esc/,
  );
  act(() => editor.store.setState({ placing: null }));
  expect(screen.getByTestId('placing')).toBeEmptyDOMElement();
});
