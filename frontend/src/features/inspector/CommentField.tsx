import { Textarea } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { setComment } from '@/model/edits';
import { change } from '@/store/project/commands';
import { Section } from './Section';
import type { Target } from './target';

export function CommentField({ id, node }: Target) {
  const { t } = useTranslation('inspector');
  return (
    <Section title={t('comment')}>
      <Textarea
        size="xs"
        autosize
        minRows={1}
        aria-label={t('comment')}
        value={node.comment ?? ''}
        onChange={(event) => {
          change('comment', [setComment(id, event.currentTarget.value)], { mergeKey: `comment ${id}` });
        }}
      />
    </Section>
  );
}
