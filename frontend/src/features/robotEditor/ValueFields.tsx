import { useTranslation } from 'react-i18next';
import { FieldGroup, NumberField, TextField } from '@/features/editor3d/fields';
import type { Json, JsonObject } from '@/model/document/values';
import { fieldsOf, type Field, type FieldsOf } from '@/model/robot/rules';

interface ValueFieldsProps {
  readonly kind: FieldsOf;
  readonly values: JsonObject;
  /** The fields that are shown elsewhere. */
  readonly without?: readonly string[];
  readonly onChange: (field: string, value: Json | undefined) => void;
}

const TITLES: Readonly<Partial<Record<FieldsOf, string>>> = { drive: 'drive', motor: 'motor' };
const TOPIC = /^\/[A-Za-z0-9_/]+$/;
const DEGREES = 180 / Math.PI;
const ANGLES = new Set(['fov', 'max_angular', 'angular_acceleration']);

/**
 * The fields for all values that the format allows for a sensor, the drive or a motor: topics first, then
 * numbers.
 */
export function ValueFields({ kind, values, without = [], onChange }: ValueFieldsProps) {
  const { t } = useTranslation('robotEditor');
  const fields = fieldsOf(kind).filter(({ name }) => !without.includes(name));
  const topics = fields.filter((field) => field.kind === 'topic');
  const numbers = fields.filter((field) => field.kind !== 'topic');
  const problem =
    ({ isOptional }: Field) =>
    (text: string) =>
      (text === '' && isOptional) || (TOPIC.test(text) && text.length <= 200) ? null : t('badTopic');
  const number = (field: Field) => {
    const value = values[field.name] ?? field.fallback;
    const factor = ANGLES.has(field.name) ? DEGREES : 1;
    return (
      <NumberField
        key={field.name}
        label={t([`field.${kind}_${field.name}`, `field.${field.name}`])}
        testId={`value-${field.name}`}
        value={(typeof value === 'number' ? value : 0) * factor}
        min={field.low * factor}
        max={field.high * factor}
        isAngle={factor > 1}
        step={field.kind === 'count' ? 10 : factor > 1 ? 5 : 0.1}
        onCommit={(wish) => onChange(field.name, field.kind === 'count' ? Math.round(wish) : wish / factor)}
      />
    );
  };
  return (
    <>
      {topics.map((field) => (
        <TextField
          key={field.name}
          label={t(`field.${field.name}`)}
          testId={`value-${field.name}`}
          value={String(values[field.name] ?? field.fallback)}
          problem={problem(field)}
          onCommit={(text) => onChange(field.name, text === '' ? undefined : text)}
        />
      ))}
      <FieldGroup title={t(TITLES[kind] ?? 'measures')} columns={2}>
        {numbers.map(number)}
      </FieldGroup>
    </>
  );
}
