import { Select } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { PICTURE, TEXTURES } from '@/model/universe/types';
import { useProjectStore } from '@/store/project';
import { isReadOnly } from '@/features/editor3d/editing';

interface TextureFieldProps {
  readonly value: string;
  readonly onChange: (texture: string | undefined) => void;
}

/** The field for a picture that repeats over a thing or the ground: a built-in one, or one of the project. */
export function TextureField({ value, onChange }: TextureFieldProps) {
  const { t } = useTranslation('universeEditor');
  const files = useProjectStore((state) => state.files);
  const own = Object.keys(files).filter((path) => PICTURE.test(path));
  const others = [...own, value].filter((path) => path && !(TEXTURES as readonly string[]).includes(path));
  return (
    <Select
      size="xs"
      label={t('texture')}
      disabled={isReadOnly()}
      allowDeselect={false}
      value={value}
      data={[
        { value: '', label: t('noTexture') },
        ...TEXTURES.map((name) => ({ value: name, label: t(`textures.${name}`) })),
        ...[...new Set(others)].map((path) => ({ value: path, label: path })),
      ]}
      onChange={(texture) => onChange(texture === '' || texture === null ? undefined : texture)}
    />
  );
}
