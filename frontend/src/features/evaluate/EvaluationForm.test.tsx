import { act, screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { firstEvaluation } from '@/model/evaluation/files';
import { useProjectStore } from '@/store/project';
import { useLargeFiles } from '@/store/saving/large';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { EvaluationForm } from './EvaluationForm';

const PATH = 'evaluations/room.yaml';
const textNow = () => useProjectStore.getState().files[PATH]?.text ?? '';

function open(text = firstEvaluation('walled_room')) {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, texts: { [PATH]: text } });
  show(<EvaluationForm name="room" onClose={vi.fn()} />);
}

it('writes each field into the text, and keeps its comments', async () => {
  open();
  await user.click(screen.getByLabelText('the tree ends with SUCCESS'));
  await user.click(screen.getByLabelText('energy_j'));
  await user.clear(screen.getByLabelText('Runs'));
  await user.type(screen.getByLabelText('Runs'), '35');
  expect(textNow()).toContain('tree: SUCCESS');
  expect(textNow()).toContain('energy_j');
  expect(textNow()).toContain('runs: 35');
  expect(textNow()).toContain('# What differs from run to run');
  await user.click(screen.getByRole('button', { name: 'Remove ground.friction' }));
  expect(textNow()).not.toContain('ground.friction');
});

it('follows the text', () => {
  open();
  act(() => useProjectStore.getState().setFileText(PATH, textNow().replace('runs: 20', 'runs: 50')));
  expect(screen.getByLabelText('Runs')).toHaveValue('50');
});

it('leads to the text, and says so if the text has errors', async () => {
  open('a: [');
  const { openFile } = watchNavigation();
  expect(screen.getByRole('alert')).toHaveTextContent('The file has errors');
  await user.click(screen.getByRole('button', { name: 'Open the YAML beside' }));
  expect(openFile).toHaveBeenCalledWith(PATH, undefined);
});

it('says that a large file is loaded, and why it cannot be', async () => {
  fakeServer({});
  open();
  act(() => {
    const large = { path: PATH, kind: 'large', text: null, revision: 1, savedText: null } as const;
    useProjectStore.setState(({ files }) => ({ files: { ...files, [PATH]: large } }));
  });
  expect(screen.getByLabelText(`${PATH} is loaded…`)).toBeInTheDocument();
  expect(await screen.findByRole('alert')).toHaveTextContent(`${PATH} could not be loaded`);
  useLargeFiles.setState({ failed: {} });
});
