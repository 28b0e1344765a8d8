import { expect, it } from 'vitest';
import { announceImport, closeImportReport, useImportReport } from './importReport';

it('is announced for one project, and closed', () => {
  const proposal = { universe: 'line', topics: '/image' };
  announceImport('p1', 'patrol.xml', proposal);
  expect(useImportReport.getState()).toEqual({ projectId: 'p1', file: 'patrol.xml', proposal, oneBlock: '' });
  closeImportReport();
  expect(useImportReport.getState().projectId).toBeNull();
});
