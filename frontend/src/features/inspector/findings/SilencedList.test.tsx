import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { nodeOf, openProject, show, user } from '../../../../harness/testing';
import { shownTarget } from '../../../../harness/target';
import { SilencedList } from './SilencedList';

const List = shownTarget('Main', SilencedList);

it('lists what is silenced with its reason, and reports it again', async () => {
  openProject({
    trees: {
      Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', silenced: { BT0119: 'later' } } },
    },
    selected: ['a'],
  });
  show(<List id="a" />);
  expect(screen.getByRole('listitem')).toHaveTextContent('BT0119 later');
  await user.click(screen.getByRole('button', { name: 'Report again' }));
  expect(nodeOf('Main', 'a')?.silenced).toBeUndefined();
  expect(screen.queryByRole('listitem')).toBeNull();
});
