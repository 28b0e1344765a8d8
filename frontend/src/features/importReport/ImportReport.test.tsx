import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { announceImport, closeImportReport } from '@/store/dialogs/importReport';
import { show } from '../../../harness/testing';
import { ImportReport } from './ImportReport';

it('belongs to the project that was imported, once', () => {
  announceImport('p1', 'patrol.xml', null);
  const { rerender } = show(<ImportReport projectId="p2" />);
  expect(screen.queryByRole('dialog')).toBeNull();
  rerender(<ImportReport projectId="p1" />);
  expect(screen.getByRole('dialog', { name: 'Imported from patrol.xml' })).toBeInTheDocument();
  closeImportReport();
});
