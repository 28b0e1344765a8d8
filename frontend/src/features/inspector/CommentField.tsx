import { Textarea } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { setComment } from '@/model/edits';
import { change } from '@/store/project/edits/blocks';
import { Section } from './Section';
import type { Target } from './target';
import classes from './Inspector.module.css';

export function CommentField({ id, node }: Target) {
  const { t } = useTranslation('inspector');
  return (
    <Section title={t('comment')}>
      <Textarea
        size="xs"
        rows={1}
        classNames={{ input: classes['growing'] ?? '' }}
        aria-label={t('comment')}
        value={node.comment ?? ''}
        onChange={(event) => {
          change('comment', [setComment(id, event.currentTarget.value)], { mergeKey: `comment ${id}` });
        }}
      />
    </Section>
  );
}
