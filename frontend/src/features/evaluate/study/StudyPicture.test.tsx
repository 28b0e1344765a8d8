import { screen } from '@testing-library/react';
import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { readStudy, type Study } from '@/model/evaluation/study';
import { show } from '../../../../harness/testing';
import { StudyPicture } from './StudyPicture';

const study = readStudy(readFileSync('../tests/shared/study.json', 'utf-8')) as Study;

it('draws each trial once in each picture', () => {
  const trials = [0.2, 0.8, null, 0.5].map((rating, number) => ({
    number,
    values: { 'MainTree.go.speed': 0.1 + number / 10 },
    rating,
  }));
  show(<StudyPicture study={{ ...study, trials }} />);
  expect(
    screen.getByRole('img', { name: /^MainTree.go.speed: 0.2 to 0.8, from 0.1 to 0.6/ }),
  ).toBeInTheDocument();
  expect(document.querySelectorAll('circle')).toHaveLength(6);
});

it('says that nothing was rated', () => {
  show(<StudyPicture study={{ ...study, trials: [] }} />);
  expect(screen.getByText('No trial could be rated.')).toBeInTheDocument();
});
