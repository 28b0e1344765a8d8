import { expect, it } from 'vitest';
import { show } from '../../../../harness/testing';
import { PlaceText } from './PlaceText';

const PLACE = { uri: '', line: 4, from: 8, to: 10, text: '    x = Go()' };

it('is a line with its number, without its indent, and the place marked', () => {
  const { container } = show(<PlaceText place={PLACE} />);
  expect(container).toHaveTextContent('5x = Go()');
  expect(container.querySelector('mark')).toHaveTextContent('Go');
});

it('shows what replaces the place', () => {
  const { container } = show(<PlaceText place={PLACE} after="Drive" />);
  expect(container.querySelector('del')).toHaveTextContent('Go');
  expect(container.querySelector('ins')).toHaveTextContent('Drive');
  expect(container).toHaveTextContent('5x = GoDrive()');
});
