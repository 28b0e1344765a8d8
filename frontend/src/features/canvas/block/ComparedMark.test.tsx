import { act, screen } from '@testing-library/react';
import i18next from 'i18next';
import { afterEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useComparing } from '@/store/moment/compare/comparing';
import { show } from '../../../../harness/testing';
import { ComparedMark } from './ComparedMark';

afterEach(() => act(() => useComparing.setState({ blocks: new Map() })));

it('tells the status that a block has in the other run, where it differs', () => {
  show(<ComparedMark block="Main/a" t={i18next.getFixedT('en', 'canvas')} />);
  expect(screen.queryByTestId('compared-Main/a')).toBeNull();
  act(() => useComparing.setState({ blocks: new Map([['Main/a', 'FAILURE']]) }));
  expect(screen.getByTestId('compared-Main/a')).toHaveTextContent('2: failure');
  act(() => useComparing.setState({ blocks: new Map([['Main/a', null]]) }));
  expect(screen.getByTestId('compared-Main/a')).toHaveTextContent('2: not there');
});
