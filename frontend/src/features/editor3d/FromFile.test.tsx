import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { closeImporting, useImporting } from '@/store/dialogs/importing';
import { show, user } from '../../../harness/testing';
import { FromFile } from './FromFile';

it('leaves its dialogue for the import of files', async () => {
  const onLeave = vi.fn();
  show(<FromFile kind="universe" onLeave={onLeave} />);
  await user.click(screen.getByRole('button', { name: 'From an SDF world or a map…' }));
  expect(onLeave).toHaveBeenCalledOnce();
  expect(useImporting.getState()).toMatchObject({ isOpen: true, kind: 'universe', source: null });
  closeImporting();
});
