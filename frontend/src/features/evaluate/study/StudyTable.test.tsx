import { screen } from '@testing-library/react';
import { readFileSync } from 'node:fs';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { readStudy, type Study } from '@/model/evaluation/study';
import { show, user } from '../../../../harness/testing';
import { StudyTable } from './StudyTable';

const study = readStudy(readFileSync('../tests/shared/study.json', 'utf-8')) as Study;

it('gives the values that are chosen, and shows defaults and undefined ratings', async () => {
  const onUse = vi.fn();
  const today = { ...study.today, texts: { 'MainTree.go.speed': '' }, rating: null };
  show(<StudyTable study={{ ...study, today }} fits={() => 'fits'} mayUse onUse={onUse} />);
  expect(screen.getByRole('row', { name: /^Today .*undefined/ })).toHaveTextContent('the default');
  await user.click(screen.getByRole('button', { name: 'Use these values' }));
  expect(onUse).toHaveBeenCalledExactlyOnceWith(study.best[0]);
});

it('shows measures as numbers, and offers viewers nothing', () => {
  const measured = { ...study, objective: 'path_length_m' };
  show(<StudyTable study={measured} fits={() => 'fits'} mayUse={false} onUse={() => undefined} />);
  expect(screen.getByRole('row', { name: /^Best 1 .*0.875/ })).toBeInTheDocument();
  expect(screen.queryByRole('button')).toBeNull();
});
