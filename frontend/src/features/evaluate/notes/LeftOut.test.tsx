import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { show } from '../../../../harness/testing';
import { LeftOut } from './LeftOut';

const WHY = 'is left out: it runs in real time, and this run in simulated time';

it('names the launch nodes without which an evaluation runs, each with its place', () => {
  show(
    <LeftOut
      notes={`launch/a.launch.py:4:1: the launch node follower ${WHY}\nlaunch/b.launch.py:9:1: the launch node map ${WHY}`}
    />,
  );
  expect(screen.getByText(/^Evaluated without 2 launch nodes/)).toBeInTheDocument();
  expect(screen.getAllByRole('listitem', { hidden: true }).map((item) => item.textContent)).toEqual([
    'follower (launch/a.launch.py:4:1) runs in real time',
    'map (launch/b.launch.py:9:1) runs in real time',
  ]);
});

it('is not there when nothing is left out', () => {
  show(<LeftOut notes="" />);
  expect(screen.queryByRole('note')).toBeNull();
});
