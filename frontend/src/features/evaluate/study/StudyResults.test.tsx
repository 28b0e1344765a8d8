import { screen, within } from '@testing-library/react';
import { readFileSync } from 'node:fs';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { readStudy, type Study } from '@/model/evaluation/study';
import { useProjectStore } from '@/store/project';
import { openProject, show, user } from '../../../../harness/testing';
import { StudyResults } from './StudyResults';

const study = readStudy(readFileSync('../tests/shared/study.json', 'utf-8')) as Study;
const portOf = () => useProjectStore.getState().diagrams['MainTree']?.nodes['a']?.ports?.['speed'];

function open(shown: Study, speed = shown.today.texts['MainTree.go.speed'] ?? '') {
  openProject({ trees: { MainTree: { a: { type: 'Drive', ports: { speed } } } } });
  const onClose = vi.fn();
  show(<StudyResults study={shown} onClose={onClose} />);
  return onClose;
}

it('shows the best values beside those of today, and sets them in one step', async () => {
  const onClose = open(study);
  expect(screen.getByRole('status')).toHaveTextContent('An improvement is shown');
  const best = screen.getByRole('row', { name: /^Best 1/ });
  expect(best).toHaveTextContent('87.5 %');
  expect(best).toHaveTextContent('0.4');
  expect(screen.getByRole('row', { name: /^Today/ })).toHaveTextContent('25 %');
  expect(screen.getByRole('img', { name: /^success by trial/ })).toBeInTheDocument();
  await user.click(within(best).getByRole('button', { name: 'Use these values' }));
  expect(portOf()).toBe('0.4');
  expect(screen.getByRole('row', { name: /^Best 1/ })).toHaveTextContent('in the trees');
  useProjectStore.getState().undo('MainTree');
  expect(portOf()).toBe(study.today.texts['MainTree.go.speed']);
  await user.click(screen.getByRole('button', { name: 'Close the tuning' }));
  expect(onClose).toHaveBeenCalledOnce();
});

it('says that the port was changed since', () => {
  open({ ...study, improvement: false }, '0.55');
  expect(screen.getByRole('status')).toHaveTextContent('No improvement is shown');
  expect(screen.getByRole('note')).toHaveTextContent('another value than when the tuning began');
});

it('offers nothing for a block that is gone, and to viewers', () => {
  openProject({ trees: { Other: { a: { type: 'Drive' } } } });
  show(<StudyResults study={study} onClose={() => undefined} />);
  expect(screen.getByText('the block is gone')).toBeInTheDocument();
  expect(screen.queryByRole('button', { name: 'Use these values' })).toBeNull();
});
