import { NativeSelect } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { morph } from '@/model/edits';
import { VARIANTS, variantOf } from '@/model/variants';
import { change } from '@/store/project/edits/blocks';
import { useProjectStore } from '@/store/project';
import type { Target } from './target';
import classes from './Inspector.module.css';

/** The field for the variant of a block: the number of cases of a Switch, the elements of a Loop. */
export function VariantField({ id, node }: Target) {
  const { t } = useTranslation('inspector');
  const specs = useProjectStore((state) => state.vocabulary.specs);
  const name = variantOf(node.type);
  if (name === null) return null;
  const texts: Readonly<Record<string, string>> = {
    ...{ LoopInt: t('types.int'), LoopDouble: t('types.double') },
    ...{ LoopString: t('types.string'), LoopBool: t('types.bool') },
  };
  return (
    <NativeSelect
      className={classes['pad'] ?? ''}
      size="xs"
      label={t(`variant.${name}`)}
      data-testid="variant"
      value={node.type}
      data={VARIANTS[name].map((type) => ({ value: type, label: texts[type] ?? type.replace(/\D/g, '') }))}
      onChange={({ currentTarget: { value } }) => {
        const ports = specs.get(value)?.ports ?? [];
        change('morph', [morph(id, { type: value }, (port) => ports.some((each) => each.name === port))]);
      }}
    />
  );
}
