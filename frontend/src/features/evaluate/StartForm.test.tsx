import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { firstEvaluation } from '@/model/evaluation/files';
import { openProject, show, user } from '../../../harness/testing';
import { StartForm } from './StartForm';

function open(costs: { name: string; cpu_s: number; workers: number }[]) {
  const texts = { 'evaluations/room.yaml': firstEvaluation('walled_room') };
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, texts });
  const start = vi.fn();
  show(<StartForm name="room" costs={costs} isStarting={false} onStart={start} />);
  return start;
}
const estimate = () => screen.getByTestId('evaluation-estimate');

it('estimates by the runs of last time, before anything runs', async () => {
  open([
    { name: 'other', cpu_s: 99, workers: 1 },
    { name: 'room', cpu_s: 1.5, workers: 2 },
  ]);
  await user.type(screen.getByLabelText('Runs'), '200');
  expect(estimate()).toHaveTextContent('200 runs take about 2 min 30 s: each 1.5 s of a processor');
  await user.clear(screen.getByLabelText('Runs'));
  expect(estimate()).not.toHaveTextContent('200 runs'); // as many as the file says
});

it('says that the first run measures it, without earlier runs', () => {
  open([]);
  expect(estimate()).toHaveTextContent('The first run measures how long the others take.');
});

it('starts by the keyboard alone, sealed if asked', async () => {
  const start = open([]);
  await user.type(screen.getByLabelText('Runs'), '5');
  await user.tab();
  await user.tab();
  expect(screen.getByLabelText('Grade mode')).toHaveFocus();
  await user.keyboard(' ');
  await user.type(screen.getByLabelText('Runs'), '{Enter}');
  expect(start).toHaveBeenCalledWith(5, true);
});
