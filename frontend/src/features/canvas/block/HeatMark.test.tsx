import { act, screen } from '@testing-library/react';
import i18next from 'i18next';
import { afterEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useProfile } from '@/store/debug/profile';
import { show } from '../../../../harness/testing';
import { HeatMark } from './HeatMark';

afterEach(() => act(() => useProfile.setState({ heat: new Map() })));

it('tells the share of a block while nodes are measured, also when it is 0', () => {
  show(<HeatMark block="Main/a" t={i18next.getFixedT('en', 'canvas')} />);
  expect(screen.queryByTestId('heat-Main/a')).toBeNull();
  act(() => useProfile.setState({ heat: new Map([['Main/a', 0.42]]) }));
  expect(screen.getByTestId('heat-Main/a')).toHaveTextContent('42 %');
  expect(screen.getByTitle('42 % of the time of all ticks')).toBeVisible();
  act(() => useProfile.setState({ heat: new Map([['Main/a', 0]]) }));
  expect(screen.getByTestId('heat-Main/a')).toHaveTextContent('0 %');
});
