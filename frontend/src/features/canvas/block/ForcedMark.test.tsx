import { act, screen } from '@testing-library/react';
import i18next from 'i18next';
import { afterEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useDebugMarks, type ForcedMark as Mark } from '@/store/debug/marks';
import { show } from '../../../../harness/testing';
import { ForcedMark } from './ForcedMark';

afterEach(() => act(() => useDebugMarks.setState({ forced: new Map() })));
const mark = (more: Partial<Mark>): Mark => ({
  status: 'SUCCESS',
  once: false,
  after: false,
  alone: false,
  ...more,
});

it.each([
  [mark({}), 'forced: SUCCESS'],
  [mark({ status: 'FAILURE', once: true }), 'forced once: FAILURE'],
  [mark({ status: 'RUNNING' }), 'frozen'],
  [mark({ status: 'RUNNING', alone: true }), 'runs alone'],
])('says what is forced: %o', (given, words) => {
  show(<ForcedMark block="Main/a" t={i18next.getFixedT('en', 'canvas')} />);
  expect(screen.queryByTestId('forced-Main/a')).toBeNull();
  act(() => useDebugMarks.setState({ forced: new Map([['Main/a', given]]) }));
  expect(screen.getByTestId('forced-Main/a')).toHaveTextContent(words);
});
