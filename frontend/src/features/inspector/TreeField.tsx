import { Select } from '@mantine/core';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { shippedDoc } from '@/i18n/shipped';
import { morph } from '@/model/edits';
import { wouldRecurse } from '@/model/vocabulary';
import { change } from '@/store/project/edits/blocks';
import { useProjectStore } from '@/store/project';
import type { Target } from './target';
import classes from './Inspector.module.css';

/** The field for the tree of a SubTree; it does not offer trees that would then contain themselves. */
export function TreeField({ tree, id, node }: Target) {
  const { t } = useTranslation('inspector');
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const choices = useMemo(
    () => [...vocabulary.trees.keys()].filter((other) => !wouldRecurse(vocabulary, tree, other)),
    [vocabulary, tree],
  );
  const description = vocabulary.trees.get(node.tree ?? '')?.description ?? '';
  return (
    <Select
      className={classes['pad'] ?? ''}
      description={shippedDoc(node.tree ?? '', description)}
      inputWrapperOrder={['label', 'input', 'description']}
      size="xs"
      label={t('tree')}
      data={choices}
      value={node.tree ?? null}
      allowDeselect={false}
      searchable
      onChange={(value) => {
        if (value !== null) change('morph', [morph(id, { type: 'SubTree', tree: value }, () => true)]);
      }}
    />
  );
}
