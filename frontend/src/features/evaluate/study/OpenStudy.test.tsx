import { screen } from '@testing-library/react';
import { readFileSync } from 'node:fs';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { show, user } from '../../../../harness/testing';
import { OpenStudy } from './OpenStudy';

const text = readFileSync('../tests/shared/study.json', 'utf-8');

it('opens a study, and says what is none', async () => {
  const onOpen = vi.fn();
  show(<OpenStudy onOpen={onOpen} />);
  const field = document.querySelector('input[type="file"]') as HTMLInputElement;
  await user.upload(field, new File(['{}'], 'tuning.json', { type: 'application/json' }));
  expect(await screen.findByRole('alert')).toHaveTextContent('This file is no result of a tuning');
  const study = new File([text], 'tuning.json', { type: 'application/json' });
  await user.upload(field, study);
  await vi.waitFor(() => expect(onOpen).toHaveBeenCalledOnce());
  await user.upload(field, study);
  await vi.waitFor(() => expect(onOpen).toHaveBeenCalledTimes(2));
  expect(screen.queryByRole('alert')).toBeNull();
});
