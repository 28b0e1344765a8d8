import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { closeImporting, openImporting } from '@/store/dialogs/importing';
import { openProject, show } from '../../../harness/testing';
import { ImportContents } from './ImportContents';

it('begins with files', () => {
  openProject({});
  openImporting('robot');
  show(<ImportContents projectId="p1" />);
  expect(screen.getByTestId('import-area')).toHaveTextContent('A robot as URDF, xacro or SDF');
  closeImporting();
});
