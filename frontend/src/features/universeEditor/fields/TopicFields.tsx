import { useQuery } from '@tanstack/react-query';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { FieldGroup, TextField } from '@/features/editor3d/fields';
import { topicsOf } from '@/model/robot/read';
import { setField } from '@/model/universe/edits';
import type { RobotThing } from '@/model/universe/types';
import { useFileText } from '@/store/saving/large';
import { edit, type UniverseEditor } from '../editor';

interface TopicFieldsProps {
  readonly editor: UniverseEditor;
  readonly thing: RobotThing;
}

const TOPIC = /^\/[A-Za-z0-9_/]+$/;

/**
 * The fields for the names of a robot's topics in this universe; an empty field keeps the robot's own name.
 */
export function TopicFields({ editor, thing }: TopicFieldsProps) {
  const { t } = useTranslation('universeEditor');
  const { key, model, topics } = thing;
  const own = useFileText(`robots/${model}/robot.yaml`);
  const shipped = useQuery({
    queryKey: ['robotConfig', model],
    queryFn: () => api.robotConfig(model),
    enabled: own === null,
    staleTime: Infinity,
    retry: false,
  });
  const named = topicsOf(own ?? shipped.data ?? '');
  if (named.length === 0) return null;
  const call = (name: string, topic: string) =>
    edit(editor, 'topics', (now) => {
      const { [name]: _before, ...others } = topics;
      const next = topic === '' ? others : { ...others, [name]: topic };
      return setField(now, key, 'topics', Object.keys(next).length > 0 ? next : undefined);
    });
  return (
    <FieldGroup title={t('topics')} columns={1}>
      {named.map(({ name, topic }) => (
        <TextField
          key={name}
          label={name}
          placeholder={topic}
          testId={`topic-of-${name}`}
          value={topics[name] ?? ''}
          problem={(wish) => (wish === '' || TOPIC.test(wish) ? null : t('robotEditor:badTopic'))}
          onCommit={(wish) => call(name, wish === topic ? '' : wish)}
        />
      ))}
    </FieldGroup>
  );
}
