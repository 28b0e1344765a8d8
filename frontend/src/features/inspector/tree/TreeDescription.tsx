import { Textarea } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { Diagram } from '@/model/diagram';
import { setDescription } from '@/model/edits';
import { descriptionOf } from '@/model/treeAttributes';
import { change } from '@/store/project/edits/blocks';
import { Section } from '../Section';
import classes from '../Inspector.module.css';

/** The tree in front with its description, shown while no block is selected. */
export function TreeDescription({ diagram }: { readonly diagram: Diagram }) {
  const { t } = useTranslation('inspector');
  return (
    <Section title={t('aboutTree')}>
      <Textarea
        size="xs"
        rows={2}
        classNames={{ input: classes['growing'] ?? '' }}
        aria-label={t('treeDescription', { name: diagram.id })}
        placeholder={t('treeDescriptionHint')}
        data-testid="tree-description"
        value={descriptionOf(diagram)}
        onChange={(event) => {
          change('describe', [setDescription(event.currentTarget.value)], { mergeKey: 'describe' });
        }}
      />
    </Section>
  );
}
