import { expect, it } from 'vitest';
import { announceImport, closeImportReport, useImportReport } from './importReport';

it('is announced for one project, and closed', () => {
  announceImport('p1', 'patrol.xml');
  expect(useImportReport.getState()).toEqual({ projectId: 'p1', file: 'patrol.xml' });
  closeImportReport();
  expect(useImportReport.getState().projectId).toBeNull();
});
