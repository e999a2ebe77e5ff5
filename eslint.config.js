import js from '@eslint/js';
import { defineConfig, globalIgnores } from 'eslint/config';
import globals from 'globals';
import tseslint from 'typescript-eslint';

/** Imports that a folder of web/ must not have: relative paths from `up` to these folders or files, and the reason. */
const towards = (names, message, up = '(\\.\\./)+') => ({ regex: `^${up}(${names})(/|\\.ts$|$)`, message });
const everywhere = towards(
  'start|main|study|stage-binding|tests|tools',
  'start.ts, main.ts, study.ts, stage-binding.ts, tests and tools know the app, never the reverse',
);

/**
 * One direction of imports: ui sees the clients and motion, export sees view and motion, video sees model and motion,
 * view, model and quality see motion, audio, motion and offline see nobody, common is seen by all, and only main.ts,
 * study.ts and stage-binding.ts know everyone.
 */
const directions = {
  common: [
    towards('audio|model|motion|quality|offline|view|export|ui|video', 'common imports nothing of ours'),
  ],
  offline: [towards('audio|model|motion|quality|view|export|ui|video', 'offline imports nothing of ours')],
  motion: [towards('audio|model|quality|view|export|ui|video', 'motion imports nothing of ours')],
  audio: [towards('motion|model|quality|view|export|ui|video', 'audio imports nothing of ours')],
  model: [towards('audio|quality|view|export|ui|video', 'model imports motion only')],
  quality: [towards('audio|model|view|export|ui|video', 'quality imports motion only')],
  view: [towards('audio|model|quality|export|ui|video', 'view imports motion only')],
  export: [towards('audio|model|quality|ui|video', 'export imports motion and view only')],
  video: [towards('audio|quality|view|export|ui', 'video imports motion and the loading of models only')],
};

/** Inside motion: math below skeleton below the rest, which the client and the worker put together. */
const motionFolders = {
  math: 'skeleton|bvh|retarget|import|fit|contact|beats|client|worker',
  skeleton: 'bvh|retarget|import|fit|contact|beats|client|worker',
  bvh: 'retarget|import|fit|contact|beats|client|worker',
  retarget: 'import|fit|contact|beats|client|worker',
  import: 'fit|contact|beats|client|worker',
  fit: 'bvh|retarget|import|contact|beats|client|worker',
  contact: 'bvh|retarget|import|fit|beats|client|worker',
  beats: 'bvh|retarget|import|fit|contact|client|worker',
};
for (const [folder, above] of Object.entries(motionFolders))
  directions[`motion/${folder}`] = [
    ...directions.motion,
    towards(above, `motion/${folder} imports only what is below it`, '\\.\\./'),
  ];

directions['audio/dsp'] = [
  ...directions.audio,
  towards(
    'client|worker|decode|analyse|features|player|playback-clock|wav|audio-element|audio-element-pair',
    'audio/dsp imports the recipe only',
    '\\.\\./',
  ),
];

/**
 * Inside ui: the store imports nothing of ui, widgets import the store's types, a feature imports store and widgets but
 * no other feature, and the shell imports them all.
 */
const features = [
  ...['files', 'generation', 'guidance', 'timeline', 'takes', 'quality', 'project', 'download'],
  'video',
  'study',
];
const uiFolders = {
  store: [...features, 'widgets', 'shell'],
  widgets: [...features, 'shell'],
  ...Object.fromEntries(
    features.map((feature) => [feature, [...features.filter((other) => other !== feature), 'shell']]),
  ),
  shell: [],
};
/** What no folder of ui imports of web/, whose folders lie at `up`. */
const outsideUi = (up) => [
  towards('view', 'main.ts hands the stage to ui', up),
  {
    regex: `^${up}(audio|model|quality|export|video)(?!/client(\\.ts)?$)(/|$)`,
    message: 'ui sees the clients of audio, model, quality, export and video only',
  },
];
const toFolder = '\\.\\./';
for (const [folder, others] of Object.entries(uiFolders))
  directions[`ui/${folder}`] = [
    ...outsideUi('\\.\\./\\.\\./'),
    ...(others.length > 0
      ? [
          towards(
            others.join('|'),
            `ui/${folder} imports none of its neighbours above it or beside it`,
            toFolder,
          ),
        ]
      : []),
  ];
directions['ui/store/actions'] = [
  ...outsideUi('\\.\\./\\.\\./\\.\\./'),
  towards(uiFolders.store.join('|'), 'the store imports nothing of ui', '\\.\\./\\.\\./'),
];
directions['ui/widgets'].push({
  regex: '^\\.\\./store/',
  allowTypeImports: true,
  message: "widgets import the store's types only",
});
export default defineConfig(
  globalIgnores(['dist', 'node_modules', '.venv', 'runs', '.scratch', 'test-results', 'playwright-report']),
  js.configs.recommended,
  {
    files: ['**/*.ts'],
    extends: [tseslint.configs.recommendedTypeChecked],
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    rules: {
      '@typescript-eslint/no-floating-promises': 'error',
      '@typescript-eslint/no-misused-promises': 'error',
      '@typescript-eslint/switch-exhaustiveness-check': 'error',
      '@typescript-eslint/consistent-type-imports': 'error',
      '@typescript-eslint/restrict-template-expressions': ['error', { allowNumber: true }],
      '@typescript-eslint/no-unused-vars': ['error', { argsIgnorePattern: '^_' }],
      eqeqeq: 'error',
    },
  },
  {
    files: ['web/**/*.ts'],
    rules: {
      'no-console': ['error', { allow: ['warn', 'error'] }],
      'max-lines-per-function': ['error', 80],
      'max-depth': ['error', 4],
    },
  },
  ...Object.entries(directions).map(([folder, patterns]) => ({
    files: [`web/${folder}/**/*.ts`],
    rules: { 'no-restricted-imports': ['error', { patterns: [everywhere, ...patterns] }] },
  })),
  {
    files: ['**/*.mjs', '*.js', '*.config.ts'],
    languageOptions: { globals: globals.node },
  },
);
