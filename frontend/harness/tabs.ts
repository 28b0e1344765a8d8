import { Model } from 'flexlayout-react';
import { onTestFinished } from 'vitest';
import { EDITORS } from '@/workspace/layoutModel';
import { openDocuments, useTabs } from '@/workspace/tabs';

/** Gives the page a place for tabs; the returned function lists the documents that are open in it. */
export function watchTabs() {
  const model = Model.fromJson({
    global: {},
    borders: [],
    layout: {
      type: 'row',
      children: [{ type: 'tabset', id: EDITORS, enableDeleteWhenEmpty: false, children: [] }],
    },
  });
  useTabs.setState({ model });
  onTestFinished(() => useTabs.setState(useTabs.getInitialState(), true));
  return () => openDocuments(model);
}
